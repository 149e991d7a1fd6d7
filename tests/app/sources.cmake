# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The tests drive the real program.
add_dependencies(test_app tofray)
target_compile_definitions(test_app PRIVATE TOFRAY_TOOL="$<TARGET_FILE:tofray>")
# … but for what it makes of measured numbers, which tests make up.
target_sources(test_app PRIVATE ${CMAKE_SOURCE_DIR}/apps/tofray/bench_energy.cpp ${CMAKE_SOURCE_DIR}/apps/tofray/experiment_report.cpp)
target_include_directories(test_app PRIVATE ${CMAKE_SOURCE_DIR}/apps/tofray)
