#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Runs a script in a copy of a bare Debian, as root, in a folder that holds what FOLDER holds, and removes the copy. Needs root, debootstrap and
# the network (packages come from where this machine's come from).
#   tools/bare_system.sh bookworm|trixie|… FOLDER <SCRIPT
# What the script leaves in out/ is put into FOLDER/out. Environment: TOFRAY_*, CUDAARCHS. The bare systems stay in build/roots, or where
# TOFRAY_ROOTS says; they are never changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
(($# == 2)) || { sed -n 's/^#   //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
((EUID == 0)) || { echo "bare_system.sh: only root may change into another system" >&2; exit 1; }
suite=$1 folder=$2
bare=${TOFRAY_ROOTS:-build/roots}/$suite
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT

if [[ ! -e $bare/etc/debian_version ]]; then
  # shellcheck disable=SC2016  # apt's own
  mirror=$(apt-get indextargets --format '$(ORIGIN) $(CODENAME) $(REPO_URI)' | awk '$1 == "Debian" && $2 !~ /-/ { print $3; exit }')
  [[ -n $mirror ]] || { echo "apt of this machine has no Debian to make a bare system of" >&2; exit 1; }
  command -v debootstrap >/dev/null || { echo "debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }
  mkdir -p "$(dirname "$bare")"
  debootstrap --variant=minbase "$suite" "$work/bare" "$mirror" >&2
  mv "$work/bare" "$bare"
fi

root=$work/root
cp -a "$bare" "$root"
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
echo 'APT::Get::Assume-Yes "true"; APT::Get::Update::Error-Mode "any"; APT::Install-Recommends "false"; quiet "2"; Dpkg::Use-Pty "0";' >"$root/etc/apt/apt.conf.d/90bare"
cp -a "$folder" "$root/work"
cat >"$root/script"
mapfile -t environment < <(env | grep -E '^(TOFRAY_(CUDA|JOBS)|CUDAARCHS)=' || true)
# (A name space of its own: what is mounted in it goes with it.)
unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
  LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive PIP_NO_INDEX=1 "${environment[@]}" \
  chroot "$root" /bin/bash -euo pipefail -c 'cd /work; sudo() { "$@"; }; set -x; . /script' 2>&1 </dev/null
if [[ -d $root/work/out ]]; then
  mkdir -p "$folder/out"
  cp -a "$root/work/out/." "$folder/out"
fi
