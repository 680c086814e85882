#!/bin/sh
# Usage: check_lines.sh ROOT
# Fails when a source file has 800 lines or more: such a file holds more than one topic.
set -eu
root=$1
limit=800
. "$(dirname "$0")/sources.sh"

list=$(sources "$root" '*.cpp' '*.h' '*.hlsl')
if [ -z "$list" ]; then
  echo "check_lines: no source files below $root" >&2
  exit 1
fi
printf '%s\n' "$list" | (
  count=0 bad=0
  while IFS= read -r file; do
    count=$((count + 1))
    lines=$(wc -l <"$file")
    if [ "$lines" -ge "$limit" ]; then
      echo "$file:$lines: error: $lines lines; a source file has fewer than $limit"
      bad=1
    fi
  done
  echo "check_lines: $count files"
  exit "$bad"
)
