# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
target_compile_options(test_extremes PRIVATE -O1)   # 100,000 scenes and cameras: worth optimising in every preset
