#!/bin/sh
# Usage: check_scripts.sh ROOT
# Fails when a shell script (by its first line) does not parse, or, in tools/ and .ci/, cannot be executed.
set -eu
root=$1
. "$(dirname "$0")/sources.sh"

list=$(sources "$root" '*.sh' 'run')
if [ -z "$list" ]; then
  echo "check_scripts: no scripts below $root" >&2
  exit 1
fi
printf '%s\n' "$list" | (
  count=0 bad=0
  while IFS= read -r file; do
    shell="sh"
    case $(head -n 1 "$file") in *bash*) shell=bash ;; esac
    count=$((count + 1))
    "$shell" -n "$file" || bad=1
    case $file in
      "$root"/tools/* | "$root"/.ci/*)
        if [ ! -x "$file" ]; then
          echo "$file:1: error: not executable (chmod +x)"
          bad=1
        fi
        ;;
    esac
  done
  echo "check_scripts: $count scripts"
  exit "$bad"
)
