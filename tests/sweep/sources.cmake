# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The program is not run: support/tool.h, whose folders tests take, knows where it is.
target_compile_definitions(test_sweep PRIVATE TOFRAY_TOOL="$<TARGET_FILE:tofray>")
