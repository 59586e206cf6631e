#!/usr/bin/env bash
# Installs what is missing, builds in release mode, and runs all tests but those labelled `slow`.
#
#   ./test.sh             that
#   ./test.sh --fuzz      runs each fuzz target for a few seconds (clang)
#   ./test.sh --sanitize  runs the unit tests with AddressSanitizer and UBSan, then with ThreadSanitizer
set -euo pipefail
cd "$(dirname "$0")"

case "${1:-}" in
  "")
    scripts/install_dependencies.sh
    scripts/build.sh release -DLAMP_BUILD_TESTS=ON
    ctest --preset release --parallel "$(nproc)"
    ;;
  --fuzz)
    scripts/install_dependencies.sh --fuzz
    scripts/build.sh fuzz
    ctest --preset fuzz --parallel "$(nproc)"
    ;;
  --sanitize)
    scripts/install_dependencies.sh
    for preset in asan tsan; do
      scripts/build.sh "$preset"
      ctest --preset "$preset" --parallel "$(nproc)"
    done
    ;;
  *)
    echo "usage: $0 [--fuzz | --sanitize]" >&2
    exit 2
    ;;
esac
