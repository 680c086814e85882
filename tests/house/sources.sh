#!/bin/sh
# Sourced by the checks. sources ROOT PATTERN...: the files below ROOT whose name fits a pattern, one a line, without
# hidden folders, build trees (wherever they are) and pictures that were drawn.
sources() (
  root=$1
  shift
  find "$root" \( -type d \( -path "$root/build" -o -path "$root/out" -o -path "$root/*" -name '.?*' ! -name .ci \
    -o -exec test -e '{}/CMakeCache.txt' \; \) \) -prune -o -type f -print | while IFS= read -r file; do
    for pattern in "$@"; do
      # shellcheck disable=SC2254  # the pattern is meant to be one
      case ${file##*/} in $pattern) printf '%s\n' "$file" && break ;; esac
    done
  done
)
