# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Some of the tests drive the real program.
add_dependencies(test_shards tofray)
target_compile_definitions(test_shards PRIVATE TOFRAY_TOOL="$<TARGET_FILE:tofray>")
add_library(kill_at_call MODULE ${folder}/kill_at_call.cpp)
target_link_libraries(kill_at_call PRIVATE ${CMAKE_DL_LIBS})
add_dependencies(test_shards kill_at_call)
target_compile_definitions(test_shards PRIVATE TOFRAY_KILL_AT_CALL="$<TARGET_FILE:kill_at_call>")
