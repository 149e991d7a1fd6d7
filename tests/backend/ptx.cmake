# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Reads device code, the file PTX: the same bits as the processor need every operation rounded to nearest, nothing approximate, no flushed
# subnormals, no fused double.
if(NOT PTX)
  message("SKIPPED: tofray was configured without nvcc, so there is no device code to look at")
  return()
endif()

set(float "\\.f32[ \t]")
function(refuse what pattern)
  file(STRINGS ${PTX} found REGEX "${pattern}")
  list(LENGTH found count)
  if(count GREATER 0)
    list(GET found 0 first)
    string(STRIP "${first}" first)
    message(FATAL_ERROR "${count} lines of PTX have ${what}, the first one: ${first}")
  endif()
endfunction()

# So that the test cannot pass on a file with nothing in it.
foreach(operation add sub mul div rcp sqrt fma)
  file(STRINGS ${PTX} rounded REGEX "[ \t]${operation}\\.rn\\.f32[ \t]")
  file(STRINGS ${PTX} all REGEX "[ \t]${operation}\\.([a-z0-9]+\\.)*f32[ \t]")
  list(LENGTH rounded rounded_count)
  list(LENGTH all all_count)
  if(rounded_count EQUAL 0 OR NOT rounded_count EQUAL all_count)
    message(FATAL_ERROR "${rounded_count} of ${all_count} ${operation}…f32 are rounded to nearest (.rn); expected all, and at least one")
  endif()
  message("${operation}.rn.f32: ${rounded_count}")
endforeach()
refuse("an approximation" "\\.approx")
refuse("flushed subnormals" "\\.ftz")
# Forms are made in double precision, with the processor's operations alone: rounded to nearest, no product fused into a sum.
refuse("a double that is not rounded to nearest" "[ \t](add|sub|mul|div|rcp|sqrt)\\.(rz|rm|rp|approx)\\.([a-z0-9]+\\.)*f64")
refuse("a fused double" "[ \t](fma|mad)\\.([a-z0-9]+\\.)*f64")
refuse("an atomic operation on doubles" "[ \t](atom|red)\\..*f64")
refuse("a function of the hardware" "[ \t](rsqrt|sin|cos|ex2|lg2|tanh|mad)\\.([a-z0-9]+\\.)*f32[ \t]")
refuse("an operation on halves" "\\.(f16|bf16)")
refuse("an atomic operation or reduction on floats" "[ \t](atom|red)\\..*f32")
# A function that is called and not written out in its place is one of ours, whose arithmetic is in this file, too: none of a library.
file(STRINGS ${PTX} calls REGEX "^[ \t]*call[. ]")
file(STRINGS ${PTX} ours REGEX "^[ \t]*_ZN([0-9]+_INTERNAL_[A-Za-z0-9_]*)?6tofray[A-Za-z0-9_]*,")
list(LENGTH calls call_count)
list(LENGTH ours our_count)
if(NOT call_count EQUAL our_count)
  message(FATAL_ERROR "${call_count} lines of PTX have a call, ${our_count} of them of a function of tofray: a function of a library is called")
endif()
# With a constant they are the processor's comparison; of two unknown numbers, one of which may be NaN, they are not.
refuse("a minimum or maximum of two unknown numbers" "[ \t](min|max)\\.f32[ \t]+%[a-z0-9]+, %[a-z0-9]+, %[a-z0-9]+;")
