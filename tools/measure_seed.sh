#!/usr/bin/env bash
# Prints the seed technique's frame times beside those that were published for the original demo on a machine of this
# kind (llvmpipe, 2 cores; docs/measured.md). The ratio is ours to theirs, so about 1 means no overhead of ours.
# Usage: tools/measure_seed.sh CAT.gltf [REPEATS]     needs build/release/bin/fur
set -euo pipefail
cat_model="${1:?usage: tools/measure_seed.sh CAT.gltf [REPEATS]}"
repeats="${2:-7}"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# size samples count published-ms
published="640x360 1 1 42
640x360 1 25 310
640x360 1 100 888
1920x1080 1 1 164
1920x1080 1 25 1119
1920x1080 1 100 3287
1920x1080 4 1 254
1920x1080 4 25 1672
1920x1080 4 100 6643"

# The median, smallest and largest of the stats file's frame_ms.
spread() { tr -d ' \n' <"$1" | sed -E 's/.*"frame_ms":\[([^]]*)\].*/\1/' | tr ',' '\n' | sort -n |
  awk '{ v[NR] = $1 } END { m = NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2; printf "%.0f %.0f %.0f", m, v[1], v[NR] }'; }

printf '%-10s %7s %5s %9s   %-8s %8s %8s %8s %6s\n' size samples cats published backend median min max ratio
while read -r size samples count ms; do
  for backend in vulkan gl; do
    build/release/bin/fur render "$cat_model" --backend "$backend" --technique seed --look seed --eye -1,2,-3 --target 0,0,0 \
      --fov 65 --size "$size" --samples "$samples" --count "$count" --repeat "$repeats" -o "$scratch/x.png" \
      --stats "$scratch/s.json" >/dev/null 2>&1
    read -r median least most <<<"$(spread "$scratch/s.json")"
    printf '%-10s %7s %5s %9s   %-8s %8s %8s %8s %6s\n' "$size" "$samples" "$count" "$ms" "$backend" "$median" "$least" "$most" \
      "$(awk -v a="$median" -v b="$ms" 'BEGIN { printf "%.2f", a / b }')"
  done
done <<<"$published"
