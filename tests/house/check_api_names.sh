#!/bin/sh
# Usage: check_api_names.sh ROOT
# Fails when rhi/ includes a backend, or when fur/ or app/ includes a graphics API's header, calls one of its functions
# or names one of its types (comments and strings may name them), or when a part's CMakeLists.txt does not check its
# include directions.
set -eu
root=$1
here=$(dirname "$0")
includes="$here/../../tools/check_includes.sh"
. "$here/sources.sh"

bad=0
sh "$includes" rhi "$root/rhi" rhi_vulkan rhi_gl fur app vulkan volk epoxy EGL GL GLES2 GLES3 GLFW || bad=1
sh "$includes" fur "$root/fur" rhi_vulkan rhi_gl app vulkan volk epoxy EGL GL GLES2 GLES3 GLFW || bad=1
sh "$includes" app "$root/app" vulkan volk epoxy EGL GL GLES2 GLES3 || bad=1

for part in rhi rhi_vulkan rhi_gl fur app; do
  lists="$root/$part/CMakeLists.txt"
  if [ -f "$lists" ] && ! grep -q '^ *fur_check_includes(' "$lists"; then
    echo "$lists:1: error: no fur_check_includes(... FORBID ...) (cmake/IncludeDirections.cmake)"
    bad=1
  fi
done

list=$(sources "$root/rhi" '*.h' '*.cpp'; sources "$root/fur" '*.h' '*.cpp'; sources "$root/app" '*.h' '*.cpp')
if [ -z "$list" ]; then
  echo "check_api_names: no source files in rhi, fur and app of $root" >&2
  exit 1
fi
printf '%s\n' "$list" | (
  count=0
  while IFS= read -r file; do
    count=$((count + 1))
    awk '
      /^[ \t]*#[ \t]*include/ { next }
      {
        line = $0
        gsub(/\\./, "", line)              # escaped characters, so that a string ends at its own quote
        gsub(/"[^"]*"/, "\"\"", line)
        gsub(/\/\*([^*]|\*[^\/])*\*\//, " ", line)
        if (block) { if (!sub(/^.*\*\//, "", line)) next; block = 0 }
        if (line !~ /\/\/.*\/\*/ && sub(/\/\*.*/, "", line)) block = 1
        sub(/\/\/.*/, "", line)
        line = " " line
        call = "[^A-Za-z0-9_](vk|gl|egl)[A-Z][A-Za-z0-9]*[ ]?[(]"
        type = "[^A-Za-z0-9_](Vk[A-Z][A-Za-z0-9]*|VK_[A-Z0-9_]+|EGL[A-Z][A-Za-z]*|EGL_[A-Z0-9_]+|GL_[A-Z0-9_]+|GL(u?int|enum|sizei|float|sync))[^A-Za-z0-9_]"
        if (match(line, call) || match(line " ", type)) {
          name = substr(line, RSTART + 1, RLENGTH - 2)
          if (name ~ /^glTF/) next         # the file format
          printf "%s:%d: error: graphics API name %s: only the backends may use it (docs/architecture.md)\n", FILENAME, FNR, name
          bad = 1
        }
      }
      END { exit bad + 0 }' "$file" || bad=1
  done
  echo "check_api_names: $count files"
  exit "$bad"
)
