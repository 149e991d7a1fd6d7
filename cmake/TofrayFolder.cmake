# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0

# Flags that every target of ours takes. No product may be fused into a sum unless the source says fma: the same bits everywhere.
# (-Wno-restrict: g++ 12 warns of std::string's own operator+. -fno-tree-slp-vectorize: from -O2 on g++ 12 drops the rounding of
# double -> float -> double where it packs two of them; tests/num/rounding_test.cpp. Clang warns of masks joined by &,
# which are bool where the number type is float.)
add_library(tofray_flags INTERFACE)
target_compile_options(tofray_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical> $<$<BOOL:${TOFRAY_WARNINGS_AS_ERRORS}>:-Werror>)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")   # g++ tells that it passed some arguments otherwise before version 10
  target_compile_options(tofray_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>)
endif()
# Where CMake joins the files of a folder into one to compile (./dev and the presets of the sanitizers: 0.4 to 0.6 of the time), a parameter hides what
# another file has, and a class that only one file knows is no fault.
if(CMAKE_UNITY_BUILD)
  target_compile_options(tofray_flags INTERFACE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

# tofray_folder(name [COLD] [PART_OF core|files|none] [SOURCES file…] [USES folder…] [LIBRARIES target…] [HEADERS target…])
#
# One folder of src/ is one target, tofray_<name>, with an include root of its own: a link in the build tree that holds the folder
# and nothing else. An include of a folder that is not named in USES therefore does not build. A folder within a folder has a name with
# a slash, a/b, and is the target tofray_a_b.
#
# PART_OF says which library has it: core is libtofray (unless another is named), files is libtofray_files; of none are the folders that
# the command line and tests alone have. LIBRARIES are linked, and who links the library statically needs them, too; HEADERS are packages
# of which nothing is linked. COLD is what reads, checks and writes and does nothing by pixel or by triangle: it takes TOFRAY_COLD_OPTIONS.
function(tofray_folder name)
  cmake_parse_arguments(arg "COLD" "PART_OF" "SOURCES;USES;LIBRARIES;HEADERS" ${ARGN})
  set(path ${name})
  string(REPLACE "/" "_" name ${path})
  set(root ${CMAKE_BINARY_DIR}/roots/${name})
  cmake_path(GET path PARENT_PATH parent)
  file(MAKE_DIRECTORY ${root}/${parent})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/${path} SYMBOLIC)
  list(TRANSFORM arg_USES REPLACE "/" "_")
  list(TRANSFORM arg_USES PREPEND tofray_)
  if(arg_SOURCES)
    add_library(tofray_${name} OBJECT ${arg_SOURCES})
    target_include_directories(tofray_${name} PUBLIC ${root})
    target_link_libraries(tofray_${name} PUBLIC ${arg_USES} PRIVATE tofray_flags ${arg_LIBRARIES} ${arg_HEADERS})
    if(arg_COLD AND CMAKE_BUILD_TYPE STREQUAL "Release")
      target_compile_options(tofray_${name} PRIVATE ${TOFRAY_COLD_OPTIONS})
    endif()
    if(TOFRAY_FUZZERS)   # which branches input takes, for the fuzz targets (kernels see no input as it was written)
      target_compile_options(tofray_${name} PRIVATE -fsanitize=fuzzer-no-link)
    endif()
    if(NOT arg_PART_OF)
      set(arg_PART_OF core)
    elseif(NOT arg_PART_OF MATCHES "^(core|files|none)$")
      message(FATAL_ERROR "tofray_folder(${name}): PART_OF is ${arg_PART_OF}, expected core, files or none")
    endif()
    set_property(GLOBAL APPEND PROPERTY tofray_${arg_PART_OF}_objects tofray_${name})
    set_property(GLOBAL APPEND PROPERTY tofray_${arg_PART_OF}_libraries ${arg_LIBRARIES})
  else()
    add_library(tofray_${name} INTERFACE)
    target_include_directories(tofray_${name} INTERFACE ${root})
    target_link_libraries(tofray_${name} INTERFACE ${arg_USES})
  endif()
endfunction()

# tofray_use_all(target): all folders, linked in as objects (command line and tests see the internals, too).
function(tofray_use_all target)
  foreach(kind objects libraries)
    set(${kind} "")
    foreach(part core files none)
      get_property(these GLOBAL PROPERTY tofray_${part}_${kind})
      list(APPEND ${kind} ${these})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES libraries)
  foreach(object ${objects})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
  endforeach()
  foreach(object ${objects})
    target_include_directories(${target} PRIVATE $<TARGET_PROPERTY:${object},INTERFACE_INCLUDE_DIRECTORIES>)
  endforeach()
  target_link_libraries(${target} PRIVATE tofray_flags ${libraries})
  tofray_add_object_files(${target})
endfunction()

# tofray_add_object_files(target): objects that CMake does not compile itself (the device code).
function(tofray_add_object_files target)
  get_property(files GLOBAL PROPERTY tofray_object_files)
  if(files)
    target_sources(${target} PRIVATE ${files})
    add_dependencies(${target} tofray_cuda_object)
  endif()
endfunction()
