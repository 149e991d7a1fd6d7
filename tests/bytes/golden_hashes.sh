#!/bin/sh
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Writes golden_hashes.txt anew. Only where numbers change on purpose: CHANGELOG.md says which, by how much and why.
#     tests/bytes/golden_hashes.sh [build folder]
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build/release}
cmake --build "$build" --target test_bytes
new=$(mktemp)
TOFRAY_WRITE_GOLDEN=$new "$build/tests/test_bytes" --gtest_filter='all/KnownBytes.come_from_the_scalar_reference/*'
sort "$new" > tests/bytes/golden_hashes.txt
rm "$new"
git --no-pager diff --stat -- tests/bytes/golden_hashes.txt
echo "Numbers changed? Then CHANGELOG.md needs a line: which, by how much and why."
