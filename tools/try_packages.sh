#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Tries packages as their users would: each kind in a bare system of its own, without compilers, by the commands of docs/systems.md, the Python of
# README.md and the lines of packaging/Dockerfile, word for word. Needs what tools/bare_system.sh needs.
#   tools/try_packages.sh bookworm|trixie|… FILE...    .deb, .whl and .tar.gz files
# shellcheck disable=SC2016  # the shells of the bare systems expand what stands in single quotes
set -euo pipefail
(($# >= 2)) || { sed -n 's/^#   //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
suite=$1
shift
mapfile -t files < <(realpath -e -- "$@")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Blocks of a document of docs/ that stand behind <!-- test: by try_packages.sh WORD -->.
blocks() { python3 tests/docs/markdown.py "docs/$1" try_packages.sh "$2"; }
# The first piece of Python of README.md.
four_lines() { awk '/^```python$/ { inside = 1; next } /^```$/ && inside { exit } inside' README.md; }

# gpu_part FILES COMMAND TOFRAY: where there are such files, the command makes tofray find the code for GPUs, and then lack a GPU at most.
gpu_part() {
  echo "if compgen -G '$1' >/dev/null; then"
  echo "  $3 doctor | grep 'the package tofray-cuda'"
  echo "  $2 $1 && if $3 doctor | grep -E 'tofray-cuda|code for GPUs'; then exit 1; fi"
  echo 'fi'
}

# trial KIND ENDING: runs the script on stdin where the files of that ending are; does nothing where there are none.
trial() {
  local kind=$1 these
  mapfile -t these < <(printf '%s\n' "${files[@]}" | grep "$2\$" || true)
  ((${#these[@]})) || { cat >/dev/null; return 0; }
  mkdir "$work/$kind"
  cp -- "${these[@]}" "$work/$kind"
  four_lines >"$work/$kind/readme.py"
  echo "=== $suite: $kind"
  { echo 'for compiler in cc c++ gcc g++ clang; do ! command -v "$compiler" || { echo "a bare system has no $compiler"; exit 1; }; done' && cat; } |
    tools/bare_system.sh "$suite" "$work/$kind"
}

{
  echo 'apt-get update >/dev/null'
  blocks systems.md deb
  echo 'python3 readme.py && cmp first/frame.npz out/frame.npz'   # render's bytes
  gpu_part './tofray-cuda_*.deb' 'apt-get install' tofray
} | trial deb '\.deb'
{
  echo 'cp ./*.deb /tmp'
  sed -n 's/^RUN //p' packaging/Dockerfile
  echo 'tofray demo >/dev/null'
} | trial container '\.deb'
{
  echo 'apt-get update >/dev/null && apt-get install python3-venv python3-numpy >/dev/null'
  blocks systems.md wheel
  echo 'v/bin/python readme.py && test -s first/frame.npz'
  gpu_part './tofray_cuda-*.whl' 'v/bin/pip install' 'v/bin/python -m tofray'
} | trial wheel '\.whl'
{
  blocks systems.md tarball
  # Nothing is amiss where there is no font, and the letters are of the font that goes along, not cairo's own.
  echo 'test -z "$(tofray-[0-9]*/bin/tofray demo -o carried 2>&1 >/dev/null)"'
  echo 'FONTCONFIG_FILE=/dev/null tofray-[0-9]*/bin/tofray demo -o plain >/dev/null 2>&1'
  echo 'if cmp -s carried/preview.png plain/preview.png; then exit 1; fi'
  gpu_part './tofray-cuda-*.tar.gz' 'tar xf' 'tofray-[0-9]*/bin/tofray'
} | trial tarball '\.tar\.gz'
echo "=== $suite: good"
