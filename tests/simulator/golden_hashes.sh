#!/bin/sh
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Writes golden_hashes.txt anew. Only where numbers change on purpose: CHANGELOG.md says which, by how much and why.
#     tests/simulator/golden_hashes.sh [build folder]
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build/release}
cmake --build "$build" --target test_simulator
new=$(mktemp)
TOFRAY_WRITE_GOLDEN=$new "$build/tests/test_simulator" --gtest_filter='all/SameBytes.*'
sort "$new" > tests/simulator/golden_hashes.txt
rm "$new"
git --no-pager diff --stat -- tests/simulator/golden_hashes.txt
echo "Numbers changed? Then CHANGELOG.md needs a line: which, by how much and why."
