# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Some of the tests drive the real program.
add_dependencies(test_shards tofray)
target_compile_definitions(test_shards PRIVATE TOFRAY_TOOL="$<TARGET_FILE:tofray>")
foreach(shim kill_at_call network_faults)   # what is loaded before the C library
  add_library(${shim} MODULE ${folder}/${shim}.cpp)
  target_link_libraries(${shim} PRIVATE ${CMAKE_DL_LIBS})
  add_dependencies(test_shards ${shim})
  string(TOUPPER ${shim} upper)
  target_compile_definitions(test_shards PRIVATE TOFRAY_${upper}="$<TARGET_FILE:${shim}>")
endforeach()
