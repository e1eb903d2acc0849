#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# tools/install-deps.sh [main|tests]: installs the Debian packages that are missing: those of the program (main, the
# default), or those of the tests as well. Where nothing is missing it needs neither root nor a network.
set -euo pipefail

main_packages=(g++ cmake ninja-build liboctomap-dev libeigen3-dev libhwy-dev libcli11-dev libfmt-dev nlohmann-json3-dev
  libosmesa6-dev libpng-dev zlib1g-dev libfreetype-dev fonts-dejavu-core libjs-three xz-utils bzip2)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev libdynamicedt3d-dev libfcl-dev libompl-dev octomap-tools
  chromium python3-numpy)

case ${1:-main} in
  main) packages=("${main_packages[@]}") ;;
  tests) packages=("${main_packages[@]}" "${test_packages[@]}") ;;
  *)
    echo "install-deps.sh: $1 is not a set of packages; one of: main, tests" >&2
    exit 2
    ;;
esac

missing=()
for package in "${packages[@]}"; do
  dpkg -s "$package" 2>/dev/null | grep -q '^Status: install ok installed$' || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

if ! command -v apt-get >/dev/null; then
  echo "install-deps.sh: this is no Debian; install what these packages hold: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps.sh: neither root nor sudo to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
