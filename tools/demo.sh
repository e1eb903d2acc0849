#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# tools/demo.sh: from a fresh checkout to a map and a page that shows it. Installs what is missing, builds the program into
# build/, unpacks the KITTI clip, and makes of it out/map.bt, out/map.ot and out/summary.json, beside OctoMap on the same
# scans; out/clean.bt and out/clean.ply, the map without what moves; and out/report/index.html: all of it to look at, with
# scores before and after and OctoMap on the same scans.
#
# The first comparison is at 0.2 m for OctoMap's sake: there it takes about a second a scan, at 0.1 m, as in the report,
# about four.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
cd -- "$root"

tools/install-deps.sh main
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DRHMAP_BUILD_TOOLS=ON
cmake --build build --target rhmap_cli
data/unpack.sh build/data

mkdir -p out
build/bin/rhmap build build/data/kitti_raw_0005 out/map.bt out/map.ot \
  --resolution 0.2 --min-range 2.7 --max-range 50 --compare --json out/summary.json
build/bin/rhmap clean build/data/kitti_raw_0005 out/clean.bt out/clean.ply --json out/clean.json
build/bin/rhmap report build/data/kitti_raw_0005 -o out/report --max-range 50
echo "open      out/report/index.html"
