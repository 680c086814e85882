#!/bin/sh
# Usage: check_rules_table.sh ROOT
# Fails when docs/rhi_rules.md names a test (`Suite.Case`) that no source file below tests/ has, or has a row of its
# tables without a test.
set -eu
root=$1
table="$root/docs/rhi_rules.md"
. "$(dirname "$0")/sources.sh"

# TEST(Suite, Case), TEST_P and TEST_F, over line ends too; one Suite.Case a line.
known=$(sources "$root/tests" '*.cpp' | while IFS= read -r file; do
  tr '\n' ' ' <"$file" | grep -o 'TEST\(_[PF]\)\{0,1\}([A-Za-z0-9_]*, *[A-Za-z0-9_]*)' || true
done | sed 's/^TEST[_PF]*(\([^,]*\), *\(.*\))$/\1.\2/' | sort -u)

awk -v known="$known" -v file="$table" '
  BEGIN { count = split(known, list, "\n"); for (i = 1; i <= count; ++i) exists[list[i]] = 1 }
  {
    rest = $0
    found = 0
    while (match(rest, /`[A-Z][A-Za-z0-9_]*\.[A-Z][A-Za-z0-9_]*`/)) {
      name = substr(rest, RSTART + 1, RLENGTH - 2)
      rest = substr(rest, RSTART + RLENGTH)
      ++found
      if (!(name in seen)) { seen[name] = 1; ++tests }
      if (name in exists) continue
      printf "%s:%d: error: there is no test %s\n", file, FNR, name
      bad = 1
    }
    if ($0 !~ /^\| / || $0 ~ /^\| (rule|feature) \|/) next
    ++rows
    if (found) next
    printf "%s:%d: error: a row without a test\n", file, FNR
    bad = 1
  }
  END {
    if (rows == 0) { printf "%s:1: error: no rows\n", file; bad = 1 }
    printf "check_rules_table: %d rows, %d tests\n", rows, tests
    exit bad + 0
  }' "$table"
