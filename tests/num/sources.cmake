# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The functions of each number type, compiled like the kernels.
function(tofray_pack set)
  string(TOUPPER ${set} upper)
  add_library(test_pack_${set} OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/num/pack_functions.cpp)
  target_compile_definitions(test_pack_${set} PRIVATE PACK_${upper})
  target_compile_options(test_pack_${set} PRIVATE -O2 -fno-math-errno -fno-trapping-math
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> ${ARGN})
  target_include_directories(test_pack_${set} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(test_pack_${set} PRIVATE tofray_flags tofray_raw)
  target_sources(test_num PRIVATE $<TARGET_OBJECTS:test_pack_${set}>)
endfunction()
target_compile_options(test_num PRIVATE -O2)   # millions of arguments: worth optimising in every preset
foreach(set ${tofray_all_kernels})
  tofray_pack(${set} ${tofray_options_${set}})
endforeach()
