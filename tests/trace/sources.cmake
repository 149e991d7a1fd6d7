# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The search of meshes by tiles, compiled like the kernels.
function(tofray_beams set)
  string(TOUPPER ${set} upper)
  add_library(test_beams_${set} OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/trace/tile_search.cpp)
  target_compile_definitions(test_beams_${set} PRIVATE TILE_SEARCH_${upper})
  target_compile_options(test_beams_${set} PRIVATE -O2 -fno-math-errno -fno-trapping-math
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized> ${ARGN})
  target_include_directories(test_beams_${set} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(test_beams_${set} PRIVATE tofray_flags tofray_trace)
  target_sources(test_trace PRIVATE $<TARGET_OBJECTS:test_beams_${set}>)
endfunction()
foreach(set ${tofray_all_kernels})
  tofray_beams(${set} ${tofray_options_${set}})
endforeach()

# What tiles look for in squares, compiled in the same way.
function(tofray_squares set)
  string(TOUPPER ${set} upper)
  add_library(test_squares_${set} OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/trace/squares.cpp)
  target_compile_definitions(test_squares_${set} PRIVATE SQUARE_SEARCH_${upper})
  target_compile_options(test_squares_${set} PRIVATE -O2 -fno-math-errno -fno-trapping-math
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized> ${ARGN})
  target_include_directories(test_squares_${set} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(test_squares_${set} PRIVATE tofray_flags tofray_pipeline)
  target_sources(test_trace PRIVATE $<TARGET_OBJECTS:test_squares_${set}>)
endfunction()
set(with_fused_products ${tofray_all_kernels})
list(REMOVE_ITEM with_fused_products scalar)
foreach(set ${with_fused_products})
  tofray_squares(${set} ${tofray_options_${set}})
endforeach()
