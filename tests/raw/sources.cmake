# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Millions of draws: worth optimising in every preset.
target_compile_options(test_raw PRIVATE -O2)
