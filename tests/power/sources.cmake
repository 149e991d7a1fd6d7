# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The sampler of BRDFs on each number type, compiled like the kernels.
function(tofray_sampling set)
  string(TOUPPER ${set} upper)
  add_library(test_sampling_${set} OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/power/sampling_functions.cpp)
  target_compile_definitions(test_sampling_${set} PRIVATE SAMPLING_${upper})
  target_compile_options(test_sampling_${set} PRIVATE -O2 -fno-math-errno -fno-trapping-math
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized> ${ARGN})
  target_include_directories(test_sampling_${set} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(test_sampling_${set} PRIVATE tofray_flags tofray_brdf)
  target_sources(test_power PRIVATE $<TARGET_OBJECTS:test_sampling_${set}>)
endfunction()
foreach(set ${tofray_all_kernels})
  tofray_sampling(${set} ${tofray_options_${set}})
endforeach()
