#!/usr/bin/env bash
# Installs the Debian packages of tools/packages.txt that are missing; says nothing when none is.
# Usage: tools/setup.sh            exit 0: all there; 1: something is missing and could not be installed
set -euo pipefail

list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"

fail() {
  printf 'setup: %s\n' "$@" >&2
  exit 1
}

# Package names of the list, without comments and blank lines.
packages() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$list"; }

missing_packages() {
  local package
  for package in $(packages); do
    # A removed package with its configuration kept is known to dpkg too, but not 'installed'.
    if [[ "$(dpkg-query -W -f='${db:Status-Status} ' "$package" 2>/dev/null)" != *installed\ * ]]; then
      echo "$package"
    fi
  done
}

apt_get() {
  local as_root=()
  [[ $EUID -eq 0 ]] || as_root=(sudo)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@"
}

[[ -r "$list" ]] || fail "cannot read $list"
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "this is not a Debian system (no dpkg-query or apt-get)." \
       "Install what these Debian packages hold by your system's own means, then build with" \
       "  cmake --preset release && cmake --build --preset release" \
       "The packages: $(packages | paste -sd' ')"
fi

mapfile -t missing < <(missing_packages)
[[ ${#missing[@]} -gt 0 ]] || exit 0

if [[ $EUID -ne 0 ]] && ! command -v sudo >/dev/null; then
  fail "packages are missing (${#missing[@]}), and this is neither root nor is there sudo. As root, run" \
       "  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
fi

echo "setup: installing ${#missing[@]} missing package(s): ${missing[*]}" >&2
# An update that fails for one source may still leave usable lists: the installation decides.
apt_get update >&2 || echo "setup: 'apt-get update' failed; trying with the lists that are there" >&2
apt_get install -y --no-install-recommends "${missing[@]}" >&2 ||
  fail "apt-get could not install: ${missing[*]}" \
       "Read its messages above. Usual causes: no network, no 'main' component in /etc/apt/sources.list," \
       "or a release other than Debian 12 (bookworm). Then run tools/setup.sh again."

mapfile -t missing < <(missing_packages)
[[ ${#missing[@]} -eq 0 ]] || fail "still missing after the installation: ${missing[*]}"
