# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Each kernel object defines its one function and nothing else that the linker could hand to a machine that cannot run it.
foreach(set scalar scalar_fma avx2 avx512)
  add_test(NAME kernel_object_${set}_defines_one_symbol
    COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} "-DOBJECTS=$<JOIN:$<TARGET_OBJECTS:tofray_kernel_${set}>,|>" -DEXPECTED=tofray_kernel_${set}
      -P ${CMAKE_CURRENT_SOURCE_DIR}/backend/kernel_symbols.cmake)
endforeach()
