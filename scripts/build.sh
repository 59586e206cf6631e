#!/usr/bin/env bash
# Configures and builds the preset `release`; arguments go to CMake's configuration.
set -euo pipefail
cd "$(dirname "$0")/.."

launcher=()
if command -v ccache >/dev/null; then
  launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
cmake --preset release "${launcher[@]}" "$@"
cmake --build --preset release
