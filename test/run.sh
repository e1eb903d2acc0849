#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# test/run.sh [CTEST_OPTION...]: installs what is missing, builds everything with its tests into build-tests/, runs the
# tests.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
cd -- "$root"

tools/install-deps.sh tests
options=(-DCMAKE_BUILD_TYPE=Release -DRHMAP_BUILD_TOOLS=ON -DRHMAP_BUILD_TESTS=ON -DRHMAP_INSTALL=ON)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
cmake -S . -B build-tests -G Ninja "${options[@]}"
cmake --build build-tests --parallel 2
ctest --test-dir build-tests --output-on-failure -j2 "$@"
