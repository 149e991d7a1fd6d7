# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The example's bridge, where MuJoCo is (Debian: libmujoco-dev); without it the tests say that they were left out.
find_path(TOFRAY_MUJOCO_INCLUDE mujoco/mujoco.h)
find_library(TOFRAY_MUJOCO_LIBRARY mujoco)
mark_as_advanced(TOFRAY_MUJOCO_INCLUDE TOFRAY_MUJOCO_LIBRARY)
if(TOFRAY_MUJOCO_INCLUDE AND TOFRAY_MUJOCO_LIBRARY AND NOT CMAKE_CROSSCOMPILING)
  target_sources(test_mujoco PRIVATE ${CMAKE_SOURCE_DIR}/examples/mujoco/mirror.cpp)
  target_include_directories(test_mujoco PRIVATE ${CMAKE_SOURCE_DIR}/examples/mujoco)
  target_include_directories(test_mujoco SYSTEM PRIVATE ${TOFRAY_MUJOCO_INCLUDE})
  target_link_libraries(test_mujoco PRIVATE ${TOFRAY_MUJOCO_LIBRARY})
  target_compile_definitions(test_mujoco PRIVATE TOFRAY_WITH_MUJOCO)

  # The example itself: python.mujoco compares its film with that of the bridge in Python.
  add_executable(mujoco_film ${CMAKE_SOURCE_DIR}/examples/mujoco/main.cpp ${CMAKE_SOURCE_DIR}/examples/mujoco/mirror.cpp)
  target_include_directories(mujoco_film SYSTEM PRIVATE ${TOFRAY_MUJOCO_INCLUDE})
  target_link_libraries(mujoco_film PRIVATE tofray_files_library ${TOFRAY_MUJOCO_LIBRARY})
endif()
