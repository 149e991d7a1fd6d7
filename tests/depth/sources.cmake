# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# A million half paths: worth optimising in every preset.
target_compile_options(test_depth PRIVATE -O2)
