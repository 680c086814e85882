#!/usr/bin/env bash
# Draws every coat of the program, near and far, into one labelled picture: on the built-in animal and, where the models
# are there, on others.
# Usage: tools/coats.sh OUT.jpg|png [COAT...]     COAT: names or files; default all of `fur info --coats`
# Environment: ASSETS, the folder of the models (default ../shared/assets); SIZE, of one picture (default 190x150).
# Needs build/release/bin/fur and ImageMagick's montage (Debian package imagemagick).
set -euo pipefail
out="${1:?usage: tools/coats.sh OUT.jpg|png [COAT...]}"
shift
cd "$(dirname "${BASH_SOURCE[0]}")/.."
fur=build/release/bin/fur
assets="${ASSETS:-../shared/assets}"
size="${SIZE:-190x150}"
command -v montage >/dev/null || { echo "tools/coats.sh: montage is missing; install the Debian package imagemagick" >&2; exit 1; }
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

if [ "$#" -eq 0 ]; then
  mapfile -t coats < <("$fur" info --coats | awk '{print $1}')
else
  coats=("$@")
fi
models=("")
for model in cat/cat.gltf spot/spot.glb torus/torus.gltf; do  # spot looks to -z
  if [ -f "$assets/$model" ]; then models+=("$assets/$model"); fi
done

pictures=()
picture() {  # LABEL, then flags of `fur render`
  local file
  file="$work/$(printf '%04d' "${#pictures[@]}").png"
  "$fur" render --samples 4 --repeat 0 --size "$size" -o "$file" "${@:2}" >/dev/null
  pictures+=(-label "$1" "$file")
}

for coat in "${coats[@]}"; do
  name="$(basename "$coat" .json)"
  for model in "${models[@]}"; do
    front=0,0,0
    if [[ "$model" == */spot.glb ]]; then front=0,0,-1; fi
    picture "$name" ${model:+"$model"} --coat "$coat" --front "$front"
  done
  picture "$name, near" --coat "$coat" --eye -1.6,1.2,1.2 --target 0,0.6,-0.1 --fov 22
  if [ -f "$assets/cat/cat.gltf" ]; then
    picture "$name, near" "$assets/cat/cat.gltf" --coat "$coat" --eye -2.4,1.9,1.6 --target 0,0.85,0.1 --fov 24
  fi
done
columns=$((${#pictures[@]} / 3 / ${#coats[@]}))
montage "${pictures[@]}" -tile "${columns}x" -geometry +1+1 -background white -pointsize 10 -quality 80 "$out"
