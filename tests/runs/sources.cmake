# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The tests drive the real program.
add_dependencies(test_runs tofray)
target_compile_definitions(test_runs PRIVATE TOFRAY_TOOL="$<TARGET_FILE:tofray>")
add_library(signal_early MODULE ${folder}/signal_early.cpp)
add_dependencies(test_runs signal_early)
target_compile_definitions(test_runs PRIVATE TOFRAY_SIGNAL_EARLY="$<TARGET_FILE:signal_early>")
