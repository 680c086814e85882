#!/bin/sh
# Usage: check_includes.sh NAME FOLDER WORD...
# Fails, naming file and line, when a source file below FOLDER includes a header whose first path component (without
# leading ./ and ../, and without .h) is one of the words. NAME is what the messages call the folder's code.
set -eu

if [ $# -lt 3 ]; then
  echo "usage: check_includes.sh NAME FOLDER WORD..." >&2
  exit 2
fi
name=$1
folder=$2
shift 2
if [ ! -d "$folder" ]; then
  echo "check_includes: no folder $folder" >&2
  exit 2
fi

FUR_NAME=$name FUR_FORBIDDEN="$*"
export FUR_NAME FUR_FORBIDDEN
find "$folder" -type f \( -name '*.h' -o -name '*.hpp' -o -name '*.inl' -o -name '*.c' -o -name '*.cpp' \) \
  -exec awk '
    BEGIN {
      count = split(ENVIRON["FUR_FORBIDDEN"], words, " ")
      for (i = 1; i <= count; ++i) forbidden[words[i]] = 1
    }
    /^[ \t]*#[ \t]*include[ \t]*["<]/ {
      path = $0
      sub(/^[ \t]*#[ \t]*include[ \t]*["<]/, "", path)
      sub(/[">].*/, "", path)
      while (sub(/^\.\.?\/+/, "", path));
      sub(/\/.*/, "", path)
      sub(/\.(h|hpp)$/, "", path)
      if (path in forbidden) {
        printf "%s:%d: error: %s must not include %s (docs/architecture.md)\n", FILENAME, FNR, ENVIRON["FUR_NAME"], path
        bad = 1
      }
    }
    END { exit bad + 0 }' {} + >&2
