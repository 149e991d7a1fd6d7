#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The libraries that tofray needs, for 64-bit ARM, in a folder of their own: what the preset `aarch64` builds against and qemu runs with.
# apt fetches them from where this machine's packages come from, into the folder alone: nothing is installed, no architecture is added.
#   tools/arm64_sysroot.sh [FOLDER]     (build/arm64-sysroot)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$(realpath -m "${1:-build/arm64-sysroot}")
packages=(libc6-dev libstdc++-12-dev libtbb-dev libyaml-cpp-dev nlohmann-json3-dev libboost1.74-dev libcli11-dev libfmt-dev libpng-dev libjpeg-dev
  libcairo2-dev zlib1g-dev libdeflate-dev libzstd-dev libzip-dev libssl-dev libgtest-dev)
[[ "$(cat "$root/complete" 2>/dev/null)" != "${packages[*]}" ]] || exit 0

mkdir -p "$root"
state=$(mktemp -d)
trap 'rm -rf "$state"' EXIT
mkdir -p "$state/lists/partial" "$state/archives/partial"
: >"$state/status"
cat >"$state/apt.conf" <<CONF
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
#clear DPkg::Post-Invoke;
Dir::State "$state";
Dir::State::Lists "$state/lists";
Dir::State::status "$state/status";
Dir::Cache "$state";
Dir::Cache::archives "$state/archives";
Acquire::Languages "none";
CONF
# Whoever is root here has apt fetch as somebody else, who has to reach the folder.
chmod 755 "$state"
if ((EUID == 0)) && id -u _apt >/dev/null 2>&1; then chown _apt "$state"/{lists,archives}/partial; fi
export APT_CONFIG=$state/apt.conf

apt-get update -q >&2
# Nothing is installed in that state, so what would be installed is all that the packages need.
mapfile -t all < <(apt-get install --simulate --no-install-recommends -q "${packages[@]}" | sed -n 's/^Inst \([^ ]*\).*/\1/p')
((${#all[@]})) || { echo "apt knows no arm64 packages here: its sources have none (Ubuntu keeps them on another server)" >&2; exit 1; }
(cd "$state/archives" && apt-get download -q "${all[@]}" >&2)
for package in "$state"/archives/*.deb; do dpkg-deb --extract "$package" "$root"; done

# Absolute links would lead out of the folder.
find "$root" -type l -lname '/*' -print0 | while IFS= read -r -d '' link; do
  ln -snf "$(realpath -ms --relative-to="$(dirname "$link")" "$root$(readlink "$link")")" "$link"
done
echo "${packages[*]}" >"$root/complete"
echo "${#all[@]} packages in $root" >&2
