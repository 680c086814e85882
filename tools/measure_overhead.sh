#!/usr/bin/env bash
# Prints what a draw costs through the RHI beside the same loop written by hand on each API: instructions of the calling
# thread (callgrind; 10,000 one-pixel triangles, 32 bytes of constants each; recording and submission), and the time of a
# frame. Instructions are exact enough to gate; times are only reported.
# Usage: tools/measure_overhead.sh [--gate] [PROGRAM]
#   --gate   no times; exit 1 when the RHI needs more than 1.05 times the instructions with a switch every 100 draws, or
#            on GL more than 1.10 times with one at every draw
set -euo pipefail
gate=0
if [ "${1:-}" = --gate ]; then
  gate=1
  shift
fi
program="${1:-$(dirname "${BASH_SOURCE[0]}")/../build/release/bin/rhi_overhead}"
limit_every_100=1.05
limit_every_draw=1.10
no_limit=99  # Vulkan's driver allocates at each switch, and malloc's share swings with what its threads freed meanwhile
rounds=5
modes="raw-vulkan rhi-vulkan raw-gl rhi-gl"

if ! command -v valgrind >/dev/null; then
  echo "measure_overhead: valgrind is not installed; it is in tools/packages.txt, and tools/setup.sh installs it" >&2
  exit 1
fi
if [ ! -x "$program" ]; then
  echo "measure_overhead: no program $program; build it first (cmake --build --preset release)" >&2
  exit 1
fi
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# run MODE COMMAND...: one frame's rasterisation is nobody's overhead, so GL draws nothing (Vulkan's driver has threads of
# its own for it).
run() {
  local mode="$1"
  shift
  if [[ $mode == *-gl ]]; then GALLIUM_NOOP=true LIBGL_ALWAYS_SOFTWARE=1 "$@"; else LP_NUM_THREADS=1 "$@"; fi
}

# count MODE: instructions of one frame in each of the two measured functions, by the thread that calls them.
count() {
  if ! run "$1" valgrind --tool=callgrind --separate-threads=yes --toggle-collect=rhi_overhead_every_100 \
    --toggle-collect=rhi_overhead_every_draw --callgrind-out-file="$scratch/$1" "$program" "$1" 1 \
    >"$scratch/$1.log" 2>&1; then
    echo "measure_overhead: $1 failed under valgrind:" >&2
    tail -n 20 "$scratch/$1.log" >&2
    return 1
  fi
  callgrind_annotate --inclusive=yes --threshold=100 "$scratch/$1-01" >"$scratch/$1.txt"
}

# instructions MODE FUNCTION: of one draw.
instructions() {
  awk -v name=":$2" 'index($0, name " ") { gsub(",", "", $1); printf "%.1f", $1 / 10000; found = 1; exit }
                     END { exit !found }' "$scratch/$1.txt"
}

over=0
# row API WHAT FUNCTION LIMIT
row() {
  local raw rhi
  raw="$(instructions "raw-$1" "$3")"
  rhi="$(instructions "rhi-$1" "$3")"
  awk -v api="$1" -v what="$2" -v raw="$raw" -v rhi="$rhi" \
    'BEGIN { printf "%-7s %-22s %9.0f %9.0f %7.3f\n", api, what, raw, rhi, rhi / raw }'
  if awk -v raw="$raw" -v rhi="$rhi" -v limit="$4" 'BEGIN { exit !(rhi > raw * limit) }'; then over=1; fi
}

# Two at a time: counting is not disturbed by company.
count raw-vulkan & first=$!
count rhi-vulkan & second=$!
wait "$first"
wait "$second"
count raw-gl & first=$!
count rhi-gl & second=$!
wait "$first"
wait "$second"

echo "instructions for each draw on the calling thread"
printf '%-7s %-22s %9s %9s %7s\n' API switch raw rhi ratio
for api in vulkan gl; do
  row $api "every 100 draws" rhi_overhead_every_100 "$limit_every_100"
  limit=$limit_every_draw
  [ $api = gl ] || limit=$no_limit
  row $api "every draw" rhi_overhead_every_draw "$limit"
done

# Both ways must have drawn the same.
for api in vulkan gl; do
  for mode in raw-$api rhi-$api; do
    LIBGL_ALWAYS_SOFTWARE=1 "$program" $mode 1 every-100 | grep picture >"$scratch/$mode.picture"
  done
  if ! cmp -s "$scratch/raw-$api.picture" "$scratch/rhi-$api.picture"; then
    echo "measure_overhead: raw-$api and rhi-$api draw different pictures; the comparison means nothing" >&2
    exit 1
  fi
done

if [ "$gate" = 0 ]; then
  for ((i = 0; i < rounds; i++)); do
    for mode in $modes; do run $mode "$program" $mode 25 >>"$scratch/$mode.times"; done
  done
  echo
  echo "milliseconds of a frame (recording, submission and waiting): median of $rounds interleaved runs, [least, most]"
  for mode in $modes; do
    for what in every-100 every-draw; do
      awk -v what=$what '$1 == what { print $2 }' "$scratch/$mode.times" | sort -n |
        awk -v mode=$mode -v what=$what '{ v[NR] = $1 } END { printf "%-11s %-11s %8.2f [%.2f, %.2f]\n", mode, what, v[int((NR + 1) / 2)], v[1], v[NR] }'
    done
  done
fi

if [ "$over" = 1 ]; then
  echo "measure_overhead: the RHI needs more than $limit_every_100 (a switch at every draw: $limit_every_draw) times the" \
    "instructions of the loop by hand" >&2
  [ "$gate" = 0 ] || exit 1
fi
