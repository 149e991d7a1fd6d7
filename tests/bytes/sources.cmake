# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Known hashes where the C library must do without fused products and wide vectors of its own (its fmaf is in software then,
# which makes the plain scalar code slow: one scene of it, all of them from the fastest).
add_test(NAME same_bytes_with_a_plain_c_library COMMAND test_bytes
  "--gtest_filter=all/KnownBytes.*fastest*:all/KnownBytes.*/demo")
set_tests_properties(same_bytes_with_a_plain_c_library PROPERTIES ENVIRONMENT "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2" TIMEOUT 1200)
