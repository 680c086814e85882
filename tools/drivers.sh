#!/usr/bin/env bash
# Runs the conformance suite on every driver that this machine has and writes the table of drivers. Drivers that lack
# something are in the table with it; a failure on a driver that is not required is no failure of this script.
# Usage: tools/drivers.sh [OUT.md]                       default docs/drivers.md
# FUR_GPU_ADAPTER: part of a hardware adapter's name, of a machine that has one: its drivers are in the table too.
# Environment: OUT, a folder that keeps the reports (JSON and pages); FUR_SWIFTSHADER_ICD, lvp_icd: descriptions of drivers.
# Needs build/release/bin/fur_conformance.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
table="${1:-docs/drivers.md}"
suite=build/release/bin/fur_conformance
work="${OUT:-$(mktemp -d)}"
mkdir -p "$work"
if [ -z "${OUT:-}" ]; then trap 'rm -rf "$work"' EXIT; fi
swiftshader="${FUR_SWIFTSHADER_ICD:-/usr/lib/chromium/vk_swiftshader_icd.json}"
lavapipe="${lvp_icd:-$(ls /usr/share/vulkan/icd.d/lvp_icd*.json)}"
reports=() adapter=()

run() {  # NAME FILTER VARIABLE=VALUE...
  local name="$1" filter="$2" code=0
  shift 2
  echo "--- $name"
  env "$@" "$suite" "${adapter[@]}" --filter "$filter" --json "$work/$name.json" --html "$work/$name.html" >"$work/$name.txt" 2>&1 || code=$?
  tail -n 1 "$work/$name.txt"
  case $code in
    0 | 8) reports+=("$work/$name.json") ;;
    *) cat "$work/$name.txt" >&2; exit "$code" ;;
  esac
}

run mesa '*' VK_DRIVER_FILES="$lavapipe" VK_ICD_FILENAMES="$lavapipe"
if [ -n "${FUR_GPU_ADAPTER:-}" ]; then adapter=(--adapter "$FUR_GPU_ADAPTER") && run gpu '*' && adapter=(); fi
if [ -f "$swiftshader" ]; then run swiftshader '*' VK_DRIVER_FILES="$swiftshader" VK_ICD_FILENAMES="$swiftshader"; fi
# Without what crashes: tests/conformance/driver_faults.txt.
run zink '-fur.*,fur.gs_shells*,fur.instanced_*,fur.sorted_*,fur.preset*,fur.technique/seed*,fur.model_as_published*' \
  VK_DRIVER_FILES="$lavapipe" VK_ICD_FILENAMES="$lavapipe" LIBGL_ALWAYS_SOFTWARE=1 MESA_LOADER_DRIVER_OVERRIDE=zink
run softpipe '*' VK_DRIVER_FILES="$lavapipe" VK_ICD_FILENAMES="$lavapipe" GALLIUM_DRIVER=softpipe
"$suite" --driver-table "${reports[@]}" >"$work/drivers.md"
mv "$work/drivers.md" "$table"
