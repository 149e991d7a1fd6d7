#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# build_progress.sh FOLDER JOBS: passes on what `cmake --build FOLDER` says (ninja or make) and adds to each step the time that the rest will take
# about. All other lines, those of the compiler above all, stay as they are.
set -euo pipefail
folder=$1 jobs=$2

# Seconds to compile, of one core of 2025; what has no row takes about `usual`. Only their ratios matter once some of them are done.
declare -A row=([tofray_kernel_avx512]=42 [tofray_kernel_avx2]=40 [tofray_kernel_scalar]=26 [tofray_kernel_scalar_fma]=22 [tofray]=19
  [tofray_scene]=16 [tofray_load]=11 [tofray_model]=10 [tofray_python]=25 [stand_in]=30 [test_bytes]=12 [test_num]=30)
usual=6

# The objects that are not there yet, by the target that they are part of.
declare -A left=()
total=0
if [[ -e $folder/compile_commands.json ]]; then
  while read -r place object; do
    target=${object%%.dir/*}
    target=${target##*/}
    [[ -e $place/$object ]] || left[$target]=$((${left[$target]-0} + ${row[$target]-$usual})) total=$((total + ${row[$target]-$usual}))
  done < <(sed -n -e '/"directory"/{s/.*: "\(.*\)".*/\1/;h}' -e '/"command"/{s/.* -o \([^ ]*\) .*/\1/;H;x;s/\n/ /p}' "$folder/compile_commands.json")
fi

# clock SECONDS: as 1:05
clock() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

start=$SECONDS finished=0
at_work=()   # make says a step when it begins, ninja when it is done: what the latest steps of make take
while IFS= read -r line; do
  if [[ $line =~ ^\[[\ 0-9/%]+\]\ (Building|Compiling|Linking|Joining) ]]; then
    if [[ $line =~ Building.*/([^/]+)\.dir/ ]]; then
      target=${BASH_REMATCH[1]}
      at_work+=("${left[$target]-0}")
      unset "left[$target]"
    fi
    if [[ $line == *%* ]]; then behind=$jobs; else behind=0; fi
    while ((${#at_work[@]} > behind)); do
      finished=$((finished + at_work[0]))
      at_work=("${at_work[@]:1}")
    done
    elapsed=$((SECONDS - start)) rest=$(((total - finished) / jobs))
    if ((finished > 30)); then rest=$(((total - finished) * elapsed / finished)); fi
    if ((rest >= 5)); then line+="  ($(clock "$elapsed"), about $(clock "$rest") left)"; fi
  fi
  printf '%s\n' "$line"
done
