# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Each kernel object defines its one function and nothing else that the linker could hand to a machine that cannot run it.
foreach(set ${tofray_kernels})
  add_test(NAME kernel_object_${set}_defines_one_symbol
    COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} "-DOBJECTS=$<JOIN:$<TARGET_OBJECTS:tofray_kernel_${set}>,|>" -DEXPECTED=tofray_kernel_${set}
      -P ${CMAKE_CURRENT_SOURCE_DIR}/backend/kernel_symbols.cmake)
endforeach()
target_sources(test_backend PRIVATE $<TARGET_OBJECTS:stand_in>)
# The device code, as the PTX that the build made of it: read, since it cannot be run here. Without nvcc the test says that it was skipped.
get_property(ptx_of_each GLOBAL PROPERTY tofray_ptx)
if(NOT ptx_of_each)
  set(ptx_of_each "none=")
endif()
foreach(one ${ptx_of_each})
  string(REGEX MATCH "^([^=]*)=(.*)$" one ${one})
  set(architecture ${CMAKE_MATCH_1})
  set(ptx ${CMAKE_MATCH_2})
  add_test(NAME ptx_of_sm_${architecture}_rounds_to_nearest
    COMMAND ${CMAKE_COMMAND} -DPTX=${ptx} -P ${CMAKE_CURRENT_SOURCE_DIR}/backend/ptx.cmake)
  set_tests_properties(ptx_of_sm_${architecture}_rounds_to_nearest PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED:")
endforeach()
# Its object shows one name and nothing that the linker could exchange for another's.
get_property(cuda_object GLOBAL PROPERTY tofray_cuda_object_file)
if(cuda_object)
  add_test(NAME cuda_object_defines_one_symbol
    COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} -DOBJECTS=${cuda_object} -DEXPECTED=tofray_cuda_runtime -P ${CMAKE_CURRENT_SOURCE_DIR}/backend/kernel_symbols.cmake)
endif()
# The loader of that code, and libraries that it finds in its place.
if(NOT TOFRAY_CUDA_APART)
  target_sources(test_backend PRIVATE ${CMAKE_SOURCE_DIR}/src/backend/cuda/load_part.cpp)
  set_property(SOURCE ${CMAKE_SOURCE_DIR}/src/backend/cuda/load_part.cpp APPEND PROPERTY COMPILE_DEFINITIONS TOFRAY_LIBRARY_ARCHITECTURE="${CMAKE_LIBRARY_ARCHITECTURE}")
  target_link_libraries(test_backend PRIVATE ${CMAKE_DL_LIBS})
endif()
foreach(kind good other foreign)
  add_library(part_${kind} MODULE backend/parts/${kind}.cpp)
  set_target_properties(part_${kind} PROPERTIES OUTPUT_NAME tofray_cuda LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/parts/${kind})
  target_include_directories(part_${kind} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} $<TARGET_PROPERTY:tofray_backend,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(part_${kind} PRIVATE tofray_flags)
  target_compile_options(part_${kind} PRIVATE ${TOFRAY_TEST_OPTIONS})
  add_dependencies(test_backend part_${kind})
endforeach()
target_compile_definitions(test_backend PRIVATE TOFRAY_PARTS="${CMAKE_BINARY_DIR}/tests/parts")
