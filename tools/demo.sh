#!/usr/bin/env bash
# Draws the built-in scene with Vulkan and with OpenGL, needing no display server and no GPU, and says how far apart
# the two pictures are: installs the missing Debian packages, builds the program, runs it.
# Usage: tools/demo.sh [options of `fur render`...]      writes out/demo.vulkan.png and out/demo.gl.png
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh

# cmake's own output matters only when it fails. bin/fur: the program by its path (the library is the target `fur`).
log="build/demo.log"
mkdir -p build out
echo "demo: building (log: $log)"
if ! { cmake --preset release && cmake --build --preset release --target bin/fur; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  echo "demo: the build failed; the whole log is $log" >&2
  exit 1
fi

pictures=(out/demo.vulkan.png out/demo.gl.png)
rm -f "${pictures[@]}"  # so that old pictures are not taken for new ones
build/release/bin/fur render --backend both -o out/demo.png --size 1280x720 --samples 4 "$@"
for picture in "${pictures[@]}"; do
  if [[ ! -s "$picture" ]]; then
    echo "demo: the program did not write $picture" >&2
    exit 1
  fi
done
echo "demo: the pictures: ${pictures[*]}"
