#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Instructions of one frame up to each stage, counted by valgrind: the same on a busy machine as on an idle one.
#     benches/instructions.sh [BUILD FOLDER...]     several: side by side (a folder of another commit lies in its own tree)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
command -v valgrind >/dev/null || { echo "valgrind is missing: apt-get install valgrind" >&2; exit 1; }
(($#)) || set -- "$here/../build/release"
scene=${TOFRAY_SCENE:-bench-primitives}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

instructions() { # PROGRAM STAGE NOISE FRAMES
  valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file=/dev/null "$1" "$scene" "$2" "$3" "$4" 2>&1 >/dev/null |
    awk '/I *refs/ { gsub(",", "", $NF); print $NF }'
}

number=0
for build; do
  number=$((number + 1))
  build=$(cd "$build" && pwd)
  libraries=(-ltofray)
  if [[ -e $build/libtofray_files.so ]]; then libraries=(-ltofray_files -ltofray); fi
  g++ -std=c++20 -O1 -I"$build/../../include" "$here/instructions.cpp" -o "$work/$number" -L"$build" "${libraries[@]}" -Wl,-rpath,"$build"
  echo "$build, $scene: thousands of instructions of a frame"
  for noise in 0 1; do
    for stage in 0 1 2 3; do
      if ((noise > 0 && stage < 2)); then continue; fi
      few=$(instructions "$work/$number" "$stage" "$noise" 2)
      more=$(instructions "$work/$number" "$stage" "$noise" 6)
      stages=(trace power raw depth) noises=(off exact)
      printf '  up to %-5s  noise %-5s  %7d\n' "${stages[stage]}" "${noises[noise]}" $(((more - few) / 4000))
    done
  done
done
