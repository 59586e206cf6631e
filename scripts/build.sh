#!/usr/bin/env bash
# Configures and builds one of CMakePresets.json: scripts/build.sh PRESET [CMake's arguments].
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:-release}
launcher=()
if command -v ccache >/dev/null; then
  launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
cmake --preset "$preset" "${launcher[@]}" "${@:2}"
cmake --build --preset "$preset"
