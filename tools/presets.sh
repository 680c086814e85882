#!/usr/bin/env bash
# Draws the pictures of docs/presets.md: the built-in animal in each preset and coat.
# Usage: tools/presets.sh [FOLDER]     default docs/presets; needs build/release/bin/fur
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder="${1:-docs/presets}"
mkdir -p "$folder"

picture() {  # NAME, then flags of `fur render`
  local name="$1"
  shift
  build/release/bin/fur render --size 420x320 --samples 4 --background 0.5,0.55,0.6 --repeat 0 -o "$folder/$name.png" "$@"
}

picture demo-fur --preset demo-fur
picture nvidia-d3d10 --preset nvidia-d3d10
picture nvidia-d3d10-combed --preset nvidia-d3d10 --spacing 0.004 --comb 0,-1,0 --comb-strength 0.8
picture gs-shells --preset gs-shells
for coat in bear panther snow tiger; do
  picture "four-coats-$coat" --preset four-coats --coat "$coat"
done
