# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The module once more, with a stand-in for CUDA's runtime that works in the host's memory, for tests of what stays on a GPU:
# `PYTHONPATH=build/release/python/with_stand_in`.
Python_add_library(tofray_python_stand_in MODULE WITH_SOABI ${CMAKE_SOURCE_DIR}/tests/python/stand_in.cpp $<TARGET_OBJECTS:tofray_python>
  $<TARGET_OBJECTS:stand_in>)
tofray_use_all(tofray_python_stand_in)   # a shared libtofray hides the place for the stand-in
target_include_directories(tofray_python_stand_in PRIVATE ${CMAKE_SOURCE_DIR}/tests)
target_link_libraries(tofray_python_stand_in PRIVATE pybind11::headers fmt::fmt PNG::PNG PkgConfig::cairo PkgConfig::fontconfig ${CMAKE_DL_LIBS})
set(with_stand_in ${CMAKE_CURRENT_BINARY_DIR}/with_stand_in)
set_target_properties(tofray_python_stand_in PROPERTIES
  OUTPUT_NAME _native LIBRARY_OUTPUT_DIRECTORY ${with_stand_in}/tofray CXX_VISIBILITY_PRESET hidden)
file(MAKE_DIRECTORY ${with_stand_in}/tofray)
foreach(file ${package})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${file} ${with_stand_in}/${file} SYMBOLIC)
endforeach()
