#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# `./dev package` of the last commit on a bare Debian of that name: packages for it, wherever one is. Needs what tools/bare_system.sh needs.
#   tools/package_on.sh bookworm|trixie|… FOLDER      where the packages go
set -euo pipefail
(($# == 2)) || { sed -n 's/^#   //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
mkdir -p "$2"
out=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git clone -q --no-hardlinks . "$work/tofray"
rm -rf "$work/tofray/out"
tools/bare_system.sh "$1" "$work/tofray" <<<'./dev package' >"$work/said" || { cat "$work/said" >&2; exit 1; }
cp "$work"/tofray/out/packages/* "$out"
ls -l "$out"
