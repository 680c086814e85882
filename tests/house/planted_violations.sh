#!/bin/sh
# Usage: planted_violations.sh SOURCE_ROOT
# Runs the house checks on a small clean tree, which must pass, and on copies of it with one violation each, which
# must fail with a message that names the planted file.
set -eu
source_root=$1
house="$source_root/tests/house"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0

fresh_tree() {
  rm -rf "$work/tree"
  mkdir -p "$work/tree/rhi/src" "$work/tree/fur/src" "$work/tree/app/src" "$work/tree/tools" "$work/tree/build" \
    "$work/tree/docs" "$work/tree/tests/rhi"
  cat >"$work/tree/rhi/src/types.cpp" <<'TEXT'
#include <vector>
#include "rhi/types.h"
// #include <vulkan/vulkan.h> and vkQueueSubmit(queue) may be talked about
TEXT
  cat >"$work/tree/fur/src/scene.cpp" <<'TEXT'
#include "rhi/device.h"
/* glDrawArrays(...) in a comment
   and vkCmdDraw(...) in its second line */
glm::vec3 v = glmFunction(1);  // glFinish()
const char* text = "glFinish(\")"; auto model = glTFLoad(text);
TEXT
  cat >"$work/tree/app/src/main.cpp" <<'TEXT'
#include <GLFW/glfw3.h>
#include "rhi_vulkan/device.h"
int main() { glfwInit(); }
TEXT
  printf '#!/bin/sh\necho fine\n' >"$work/tree/tools/fine.sh"
  chmod +x "$work/tree/tools/fine.sh"
  printf 'TEST_P(ClearTest,\n       WholeView) {\nTEST(Codes, Stable) {\n' >"$work/tree/tests/rhi/clear_test.cpp"
  printf '| rule | tests |\n|---|---|\n| clears | `ClearTest.WholeView`, `Codes.Stable` |\n' \
    >"$work/tree/docs/rhi_rules.md"
  # What is built is nobody's source.
  printf 'if then\n' >"$work/tree/build/broken.sh"
}

passes() {
  if ! sh "$house/$1" "$work/tree" >"$work/output" 2>&1; then
    echo "error: $1 fails $2:"
    cat "$work/output"
    bad=1
  fi
}

# fails CHECK FILE: the tree now has a violation in FILE.
fails() {
  if sh "$house/$1" "$work/tree" >"$work/output" 2>&1; then
    echo "error: $1 passes the violation planted in $2:"
    cat "$work/tree/$2"
    bad=1
  elif ! grep -q "$2" "$work/output"; then
    echo "error: $1 fails without naming $2:"
    cat "$work/output"
    bad=1
  fi
}

# planted CHECK FILE LINE: a clean tree with one more line in FILE.
planted() {
  fresh_tree
  printf '%s\n' "$3" >>"$work/tree/$2"
  fails "$1" "$2"
}

for check in check_lines.sh check_api_names.sh check_scripts.sh check_rules_table.sh; do
  fresh_tree
  passes "$check" "a clean tree"
done

fresh_tree
yes '//' | head -n 799 >"$work/tree/rhi/src/long.h"
passes check_lines.sh "799 lines"
echo '//' >>"$work/tree/rhi/src/long.h"
fails check_lines.sh rhi/src/long.h

planted check_api_names.sh rhi/src/types.cpp '#include "rhi_vulkan/device.h"'
planted check_api_names.sh rhi/src/types.cpp '  #  include <volk.h>'
planted check_api_names.sh rhi/src/types.cpp '#include "../../rhi_gl/src/device.h"'
planted check_api_names.sh rhi/src/types.cpp 'void f() { vkQueueSubmit(q, 1); }'
planted check_api_names.sh fur/src/scene.cpp '#include <epoxy/gl.h>'
planted check_api_names.sh fur/src/scene.cpp '#include "rhi_gl/device.h"'
planted check_api_names.sh fur/src/scene.cpp 'void f() { ::glFinish(); }'
planted check_api_names.sh fur/src/scene.cpp 'glClear(GL_COLOR_BUFFER_BIT);  // glTF'
planted check_api_names.sh fur/src/scene.cpp 'VkImage image{};'
planted check_api_names.sh app/src/main.cpp '#include <vulkan/vulkan.h>'
planted check_api_names.sh app/src/main.cpp '#include <EGL/egl.h>'
planted check_api_names.sh app/src/main.cpp 'auto d = eglGetDisplay(0);'
planted check_api_names.sh app/src/main.cpp '/* one line */ vkCmdDraw(c);'

planted check_api_names.sh rhi/CMakeLists.txt '# fur_check_includes(rhi FORBID app)'

planted check_rules_table.sh docs/rhi_rules.md '| masks | `ClearTest.NoSuchCase` |'
planted check_rules_table.sh docs/rhi_rules.md '| masks | nothing yet |'

planted check_scripts.sh tools/fine.sh 'if true; then'
fresh_tree
chmod -x "$work/tree/tools/fine.sh"
fails check_scripts.sh tools/fine.sh

[ "$bad" = 0 ] && echo "planted_violations: every check passes what is clean and fails what is not"
exit "$bad"
