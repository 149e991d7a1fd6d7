# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The tests talk to the real program over sockets.
add_dependencies(test_foxglove tofray)
target_compile_definitions(test_foxglove PRIVATE TOFRAY_TOOL="$<TARGET_FILE:tofray>")
if(TARGET tofray_viewer)
  target_compile_definitions(test_foxglove PRIVATE TOFRAY_HAS_VIEW)
endif()
