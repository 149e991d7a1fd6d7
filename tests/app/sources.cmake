# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The tests drive the real program.
add_dependencies(test_app tofray)
target_compile_definitions(test_app PRIVATE TOFRAY_TOOL="$<TARGET_FILE:tofray>")
# Those of measuring do not: there tests make numbers up, and put a stand-in for CUDA in the GPU's place.
foreach(name bench/bench bench/bench_batch bench/bench_compare bench/bench_energy bench/experiment bench/experiment_report cli/console cli/progress cli/remarks cli/requests commands/results)
  target_sources(test_app PRIVATE ${CMAKE_SOURCE_DIR}/apps/tofray/${name}.cpp)
endforeach()
target_include_directories(test_app PRIVATE ${CMAKE_SOURCE_DIR}/apps/tofray)
target_sources(test_app PRIVATE $<TARGET_OBJECTS:stand_in>)
