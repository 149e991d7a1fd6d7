# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0

# The library as others use it: libtofray with its headers, the command, the data, and a CMake package for find_package(tofray).
include(CMakePackageConfigHelpers)
option(BUILD_SHARED_LIBS "Build libtofray as a shared library" ON)

get_property(tofray_objects GLOBAL PROPERTY tofray_objects)
list(TRANSFORM tofray_objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE tofray_object_files)
get_property(tofray_private_libraries GLOBAL PROPERTY tofray_libraries)
list(REMOVE_DUPLICATES tofray_private_libraries)

# All that is behind the API (YAML, PNG, …) is linked privately: who links the shared library needs none of it.
add_library(tofray_library ${tofray_object_files})
add_library(tofray::tofray ALIAS tofray_library)
set_target_properties(tofray_library PROPERTIES
  OUTPUT_NAME tofray EXPORT_NAME tofray LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_compile_features(tofray_library PUBLIC cxx_std_20)
target_include_directories(tofray_library PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(tofray_library PRIVATE ${tofray_private_libraries})
tofray_add_object_files(tofray_library)
if(BUILD_SHARED_LIBS)
  # Only the API is visible from outside, so that what we link cannot clash with another version of it in the user's program.
  target_link_options(tofray_library PRIVATE LINKER:--version-script=${CMAKE_SOURCE_DIR}/cmake/tofray.map)
  set_property(TARGET tofray_library APPEND PROPERTY LINK_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/tofray.map)
endif()

install(TARGETS tofray_library EXPORT tofray-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
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
configure_package_config_file(cmake/tofray-config.cmake.in ${CMAKE_BINARY_DIR}/tofray-config.cmake INSTALL_DESTINATION ${tofray_package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/tofray-config-version.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT tofray-targets NAMESPACE tofray:: DESTINATION ${tofray_package_dir})
install(FILES ${CMAKE_BINARY_DIR}/tofray-config.cmake ${CMAKE_BINARY_DIR}/tofray-config-version.cmake DESTINATION ${tofray_package_dir})

# Completion, written by the command itself, where the shells look for it.
if(NOT CMAKE_CROSSCOMPILING)
  install(CODE "
    foreach(place IN ITEMS bash=bash-completion/completions/tofray zsh=zsh/site-functions/_tofray fish=fish/vendor_completions.d/tofray.fish)
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
