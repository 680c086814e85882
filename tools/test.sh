#!/usr/bin/env bash
# Installs the missing Debian packages, builds everything and runs all tests; the exit code is ctest's.
# Usage: tools/test.sh [options of ctest...]             FUR_WERROR=ON makes warnings errors
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
cmake --preset release ${FUR_WERROR:+-DFUR_WERROR="$FUR_WERROR"}
cmake --build --preset release

# An empty shader cache: what a driver says of a shader it says only when it compiles it.
export MESA_SHADER_CACHE_DIR="$PWD/build/release/driver_cache"
rm -rf "$MESA_SHADER_CACHE_DIR"
unset DISPLAY WAYLAND_DISPLAY  # no test may lean on a display server that happens to run
exec ctest --preset release --output-on-failure --no-tests=error -j 2 "$@"
