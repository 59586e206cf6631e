#!/usr/bin/env bash
# Installs what is missing, builds in release mode, and runs all tests but those labelled `slow`.
set -euo pipefail
cd "$(dirname "$0")"

scripts/install_dependencies.sh
scripts/build.sh -DLAMP_BUILD_TESTS=ON
ctest --preset release --parallel "$(nproc)"
