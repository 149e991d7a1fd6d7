# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0

# The libraries as others use them, with their headers: libtofray computes, libtofray_files reads what people write. The command, the
# data, and a CMake package for find_package(tofray), which gives tofray::tofray and tofray::files.
include(CMakePackageConfigHelpers)
option(BUILD_SHARED_LIBS "Build libtofray and libtofray_files as shared libraries" ON)

# tofray_make_library(target name part [folder…]): the folders that are part of it, and further ones. All that is behind the API (YAML,
# zip, …) is linked privately: who links the shared library needs none of it.
function(tofray_make_library target name part)
  get_property(folders GLOBAL PROPERTY tofray_${part}_objects)
  get_property(libraries GLOBAL PROPERTY tofray_${part}_libraries)
  list(REMOVE_DUPLICATES libraries)
  list(APPEND folders ${ARGN})
  list(TRANSFORM folders REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  add_library(${target} ${objects})
  add_library(tofray::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PRIVATE ${libraries})
  install(TARGETS ${target} EXPORT tofray-targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# Only the API is visible from outside, so that what we link cannot clash with another version of it in the user's program.
function(tofray_show_only target map)
  if(BUILD_SHARED_LIBS)
    target_link_options(${target} PRIVATE LINKER:--version-script=${map})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${map})
  endif()
endfunction()

tofray_make_library(tofray_library tofray core)
set_target_properties(tofray_library PROPERTIES OUTPUT_NAME tofray)
tofray_add_object_files(tofray_library)
tofray_show_only(tofray_library ${CMAKE_SOURCE_DIR}/cmake/tofray.map)

# The shared libtofray shows no internals, so the other one has what it needs of them once more; archives share them.
set(shared_by_both "")
if(BUILD_SHARED_LIBS)
  set(shared_by_both tofray_base tofray_model tofray_camera_readout)
endif()
tofray_make_library(tofray_files_library files files ${shared_by_both})
set_target_properties(tofray_files_library PROPERTIES OUTPUT_NAME tofray_files INSTALL_RPATH $ORIGIN)   # libtofray lies beside it
target_link_libraries(tofray_files_library PUBLIC tofray_library)
tofray_show_only(tofray_files_library ${CMAKE_SOURCE_DIR}/cmake/tofray_files.map)

install(DIRECTORY include/tofray DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(data profiles scenes)
  if(IS_DIRECTORY ${CMAKE_SOURCE_DIR}/${data})
    install(DIRECTORY ${data} DESTINATION ${CMAKE_INSTALL_DATADIR}/tofray)
  endif()
endforeach()

get_property(tofray_programs DIRECTORY apps/tofray PROPERTY BUILDSYSTEM_TARGETS)
foreach(program ${tofray_programs})
  get_target_property(type ${program} TYPE)
  if(type STREQUAL "EXECUTABLE")
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()

set(tofray_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tofray)
set(tofray_is_shared ${BUILD_SHARED_LIBS})
set(tofray_zstd_module "")
if(TARGET PkgConfig::libzstd)
  set(tofray_zstd_module libzstd)
endif()
configure_package_config_file(cmake/tofray-config.cmake.in ${CMAKE_BINARY_DIR}/tofray-config.cmake INSTALL_DESTINATION ${tofray_package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/tofray-config-version.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT tofray-targets NAMESPACE tofray:: DESTINATION ${tofray_package_dir})
install(FILES ${CMAKE_BINARY_DIR}/tofray-config.cmake ${CMAKE_BINARY_DIR}/tofray-config-version.cmake DESTINATION ${tofray_package_dir})

# For builds without CMake: pkg-config --cflags --libs tofray-files. (Static libraries leave it to CMake to say what they need.)
if(BUILD_SHARED_LIBS)
  file(RELATIVE_PATH tofray_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" tofray_pc_prefix ${tofray_pc_prefix})
  foreach(name tofray tofray-files)
    configure_file(cmake/${name}.pc.in ${CMAKE_BINARY_DIR}/${name}.pc @ONLY)
    install(FILES ${CMAKE_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  endforeach()
endif()

# Completion, written by the command itself, where the shells look for it.
set(TOFRAY_ZSH_DIR zsh/site-functions CACHE STRING "Folder below share for zsh's completion (Debian's own packages: zsh/vendor-completions)")
if(NOT CMAKE_CROSSCOMPILING)
  install(CODE "
    foreach(place IN ITEMS bash=bash-completion/completions/tofray zsh=${TOFRAY_ZSH_DIR}/_tofray fish=fish/vendor_completions.d/tofray.fish)
      string(REGEX MATCH \"^[a-z]+\" shell \${place})
      string(REPLACE \"\${shell}=\" \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/\" file \${place})
      get_filename_component(folder \${file} DIRECTORY)
      file(MAKE_DIRECTORY \${folder})
      message(STATUS \"Installing: \${file}\")
      execute_process(COMMAND \"$<TARGET_FILE:tofray>\" completion \${shell} OUTPUT_FILE \${file} RESULT_VARIABLE status)
      if(NOT status EQUAL 0)
        message(FATAL_ERROR \"tofray completion \${shell} failed\")
      endif()
    endforeach()")
endif()
