# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The device code: configured where nvcc 12.1 or newer is found. The rest of tofray, its packages and its tests are the same without it.
# Sets TOFRAY_HAS_CUDA; with it tofray_object_files get one object that holds the kernels of all architectures and the part of CUDA's
# runtime that they need, so that nobody who uses tofray has to have CUDA, and the program starts where there is no driver.
set(TOFRAY_CUDA AUTO CACHE STRING "AUTO: with CUDA where nvcc is found; ON: fail where it is not; OFF: without")
set_property(CACHE TOFRAY_CUDA PROPERTY STRINGS AUTO ON OFF)
set(default_architectures major)
if(DEFINED ENV{CUDAARCHS})   # as CMake's own CUDA language takes it
  set(default_architectures $ENV{CUDAARCHS})
endif()
set(TOFRAY_CUDA_ARCHITECTURES ${default_architectures} CACHE STRING
  "GPUs with code of their own: a list as 75;80;90, of which 75-virtual has PTX alone; all (that nvcc knows from 70 on), or major (the first of each generation, which the others run)")
set(TOFRAY_HAS_CUDA FALSE)

# Sets `result` to the path of an nvcc that is new enough, or `reason` to what is wrong.
function(tofray_find_nvcc result reason)
  find_program(TOFRAY_NVCC nvcc HINTS $ENV{CUDA_HOME}/bin $ENV{CUDA_PATH}/bin /usr/local/cuda/bin DOC "CUDA's compiler")
  set(${reason} "no nvcc was found" PARENT_SCOPE)
  if(NOT TOFRAY_NVCC)
    return()
  endif()
  execute_process(COMMAND ${TOFRAY_NVCC} --version OUTPUT_VARIABLE text ERROR_QUIET RESULT_VARIABLE status)
  string(REGEX MATCH "release ([0-9.]+)" found "${text}")
  set(version "${CMAKE_MATCH_1}")
  set(${reason} "${TOFRAY_NVCC} is version ${version}; 12.1 or newer is needed" PARENT_SCOPE)
  if(status EQUAL 0 AND found AND version VERSION_GREATER_EQUAL 12.1)
    set(${result} ${TOFRAY_NVCC} PARENT_SCOPE)
    message(STATUS "CUDA: ${TOFRAY_NVCC}, version ${version}")
  endif()
endfunction()

# The numbers of TOFRAY_CUDA_ARCHITECTURES.
function(tofray_cuda_architectures result)
  execute_process(COMMAND ${nvcc} --list-gpu-arch OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[0-9]+" known "${text}")
  list(FILTER known EXCLUDE REGEX "^[0-6].$")   # before 70: no kernel arguments of more than 4 kB
  list(SORT known COMPARE NATURAL)
  set(numbers ${known})
  if(TOFRAY_CUDA_ARCHITECTURES STREQUAL "major")
    set(numbers "")
    set(last "")
    foreach(number ${known})
      string(REGEX REPLACE ".$" "" generation ${number})
      if(NOT generation STREQUAL last)
        list(APPEND numbers ${number})
      endif()
      set(last ${generation})
    endforeach()
  elseif(NOT TOFRAY_CUDA_ARCHITECTURES STREQUAL "all")
    set(numbers ${TOFRAY_CUDA_ARCHITECTURES})
    list(SORT numbers COMPARE NATURAL)
    foreach(number ${numbers})
      if(NOT number MATCHES "^[0-9]+(-virtual)?$")
        message(FATAL_ERROR "TOFRAY_CUDA_ARCHITECTURES: ${number} is no compute capability; expected a list of numbers as 75;90 or 75-virtual;90, all or major")
      endif()
    endforeach()
  endif()
  set(${result} ${numbers} PARENT_SCOPE)
endfunction()

set(nvcc "")
if(TOFRAY_CUDA)
  tofray_find_nvcc(nvcc why_not)
  if(NOT nvcc AND NOT TOFRAY_CUDA STREQUAL "AUTO")
    message(FATAL_ERROR "TOFRAY_CUDA is ${TOFRAY_CUDA}, but ${why_not}")
  elseif(NOT nvcc)
    message(STATUS "CUDA: without; ${why_not}")
  endif()
endif()
if(nvcc)
  set(TOFRAY_HAS_CUDA TRUE)
  tofray_cuda_architectures(architectures)
  message(STATUS "CUDA: code for ${architectures} and PTX")
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/cuda)
  set(objects ${CMAKE_CURRENT_BINARY_DIR}/cuda)
  file(MAKE_DIRECTORY ${objects})

  # The same bits as the processor: no product is fused into a sum, division and square root are IEEE's, subnormals are kept.
  set(tofray_nvcc_flags -std=c++20 -O3 --fmad=false --prec-div=true --prec-sqrt=true --ftz=false --expt-relaxed-constexpr -I${CMAKE_SOURCE_DIR}/include)
  foreach(root base num flow shape brdf scene camera trace power raw depth pipeline backend)
    list(APPEND tofray_nvcc_flags -I${CMAKE_BINARY_DIR}/roots/${root})
  endforeach()
  set(code "")
  list(GET architectures -1 last)
  foreach(number ${architectures})
    string(REPLACE "-virtual" "" newest ${number})
    if(number STREQUAL newest)
      list(APPEND code -gencode arch=compute_${newest},code=sm_${newest})
    endif()
    if(NOT number STREQUAL newest OR number STREQUAL last)
      list(APPEND code -gencode arch=compute_${newest},code=compute_${newest})
    endif()
  endforeach()

  # The PTX that the machine code is made of stays, for the tests to read. (No compiler cache: it would bring back the object alone.)
  list(LENGTH architectures count)
  foreach(number ${architectures})
    string(REPLACE "-virtual" "" number ${number})
    set(ptx ${objects}/kernels.compute_${number}.ptx)
    if(count EQUAL 1)
      set(ptx ${objects}/kernels.ptx)
    endif()
    set_property(GLOBAL APPEND PROPERTY tofray_ptx "${number}=${ptx}")
  endforeach()

  set(pieces "")
  foreach(file kernels cuda_runtime)
    set(which ${code} --keep --keep-dir ${objects})
    if(file STREQUAL "cuda_runtime")   # nothing of it runs on the device
      set(which -gencode arch=compute_${newest},code=compute_${newest})
    endif()
    add_custom_command(OUTPUT ${objects}/${file}.o
      COMMAND ${nvcc} ${tofray_nvcc_flags} ${which} -Xcompiler=-fPIC,-ffp-contract=off,-fno-gnu-unique --threads 2
        -MD -MF ${objects}/${file}.d -MT ${objects}/${file}.o -c ${folder}/${file}.cu -o ${objects}/${file}.o
      DEPENDS ${folder}/${file}.cu DEPFILE ${objects}/${file}.d COMMENT "Compiling ${file}.cu for ${architectures} and PTX" COMMAND_EXPAND_LISTS VERBATIM)
    list(APPEND pieces ${objects}/${file}.o)
  endforeach()

  # One object out of them and CUDA's runtime, of which nothing shows but our one function. (Groups are dissolved: the linker would throw
  # away those that other objects have, too, and with them what our local names refer to. That takes GNU's linker, which is there with the
  # g++ that nvcc calls; CMAKE_LINKER is LLVM's where clang compiles the rest.)
  get_filename_component(toolkit ${nvcc} REALPATH)
  get_filename_component(toolkit ${toolkit}/../.. ABSOLUTE)
  find_library(TOFRAY_CUDART cudart_static HINTS ${toolkit}/lib64 ${toolkit}/targets/x86_64-linux/lib REQUIRED DOC "CUDA's runtime")
  find_program(TOFRAY_GNU_LINKER NAMES ld.bfd ld REQUIRED DOC "GNU's linker, to join the device code and CUDA's runtime")
  find_program(TOFRAY_GNU_OBJCOPY NAMES objcopy REQUIRED DOC "GNU's objcopy, to hide CUDA's runtime")
  set(object ${objects}/tofray_cuda.o)
  add_custom_command(OUTPUT ${object}
    COMMAND ${TOFRAY_GNU_LINKER} -r --force-group-allocation -o ${object}.all ${pieces} ${TOFRAY_CUDART}
    COMMAND ${TOFRAY_GNU_OBJCOPY} --keep-global-symbol=tofray_cuda_runtime ${object}.all ${object}
    COMMAND ${CMAKE_COMMAND} -E rm ${object}.all
    DEPENDS ${pieces} COMMENT "Joining the device code and CUDA's runtime" VERBATIM)
  add_custom_target(tofray_cuda_object DEPENDS ${object})
  set_property(GLOBAL APPEND PROPERTY tofray_object_files ${object})
endif()
