#!/usr/bin/env bash
# Proves that tools/packages.txt is complete: runs the demo in a fresh minimal Debian (debootstrap, variant minbase)
# into which nothing but tools/setup.sh installs anything. Needs root, debootstrap and a Debian mirror.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tools/prove_packages.sh [options]
  --root DIR     where the Debian tree goes (default: build/prove/root)
  --keep         leave the tree there at the end (default: remove it)
  --reuse        use the tree of an earlier --keep, with its packages and build; made anew if packages.txt has changed
  --setup-only   only install the packages
  --tests        run tools/test.sh too, after the demo
TEXT
}

fail() {
  printf 'prove_packages: %s\n' "$@" >&2
  exit 1
}

repo="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
root="$repo/build/prove/root"
keep=no reuse=no setup_only=no tests=no
while [[ $# -gt 0 ]]; do
  case "$1" in
    --root) root="${2:?--root needs a folder}"; shift ;;
    --keep) keep=yes ;;
    --reuse) reuse=yes ;;
    --setup-only) setup_only=yes ;;
    --tests) tests=yes ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

[[ $EUID -eq 0 ]] || fail "needs root (chroot, mount)"
command -v debootstrap >/dev/null || fail "needs debootstrap: apt-get install debootstrap"
mkdir -p "$root"
root="$(cd "$root" && pwd -P)"
[[ "$root" != / ]] || fail "--root must not be /"
suite="$(. /etc/os-release && echo "${VERSION_CODENAME:-bookworm}")"
list_used="$root/var/lib/fur-packages.txt"  # marks a tree of ours, and says which list it was made with

unmount_all() {
  local mounted
  for mounted in "$root/dev/shm" "$root/proc"; do
    if mountpoint -q "$mounted"; then umount "$mounted" || umount -l "$mounted"; fi
  done
}

# Never deletes through a mount: the tree goes only once nothing is mounted in it.
remove_tree() {
  unmount_all
  if grep -q " $root/" /proc/mounts; then fail "something is still mounted below $root; not removing it"; fi
  rm -rf --one-file-system "$root"
}

clean_up() {
  local status=$?
  unmount_all
  if [[ $keep == no ]]; then remove_tree; fi
  exit "$status"
}

# The host's Debian sources: files that name this release and its 'main' component.
debian_sources() {
  local file
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
    if [[ -f "$file" ]] && grep -qE "^[^#]*\b$suite\b" "$file" && grep -qE '^[^#]*\bmain\b' "$file"; then
      echo "$file"
    fi
  done
}

mirror() {
  local file found
  for file in $(debian_sources); do
    found="$(grep -v '^#' "$file" | grep -oE 'https?://[^ ]+/debian/?( |$)' | head -n 1 | tr -d ' ')"
    if [[ -n "$found" ]]; then
      echo "$found"
      return
    fi
  done
  echo "http://deb.debian.org/debian"
}

# apt inside sees the same mirrors, proxies and certificates as apt outside.
copy_apt_configuration() {
  local file
  rm -f "$root/etc/apt/sources.list"
  for file in $(debian_sources); do cp "$file" "$root$file"; done
  [[ -n "$(debian_sources)" ]] || echo "deb $(mirror) $suite main" >"$root/etc/apt/sources.list"
  cp -a /etc/apt/keyrings/. "$root/etc/apt/keyrings/" 2>/dev/null || true
  apt-config dump --format '%F "%v";%n' Acquire | grep -iE 'proxy|check-date|check-valid|https?::' |
    grep -v '""' >"$root/etc/apt/apt.conf.d/90host" || true
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  cp -L /etc/hosts "$root/etc/hosts"
  if grep -rqs 'https://' "$root/etc/apt/" && [[ -f /etc/ssl/certs/ca-certificates.crt ]]; then
    mkdir -p "$root/etc/ssl/certs"
    cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
  fi
}

make_tree() {
  remove_tree
  mkdir -p "$root/var/lib"
  echo "not finished" >"$list_used"
  echo "prove_packages: debootstrap $suite into $root"
  debootstrap --variant=minbase "$suite" "$root" "$(mirror)" >"$root.log" 2>&1 ||
    { tail -n 20 "$root.log" >&2; fail "debootstrap failed (whole log: $root.log)"; }
  rm -f "$root.log"
  copy_apt_configuration
  cp "$repo/tools/packages.txt" "$list_used"
}

mount_all() {
  mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
  mkdir -p "$root/dev/shm"
  mountpoint -q "$root/dev/shm" || mount -t tmpfs tmpfs "$root/dev/shm"  # the software drivers share memory here
}

# The working tree as it is (committed or not), less what is built; an earlier build inside stays for --reuse.
copy_sources() {
  mkdir -p "$root/src/fur"
  find "$root/src/fur" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  tar -C "$repo" --exclude=./build --exclude=./out --exclude=./.git -cf - . | tar -C "$root/src/fur" -xf -
}

inside() {
  chroot "$root" /usr/bin/env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    HOME=/root LANG=C.UTF-8 ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    bash -c "cd /src/fur && $1"
}

check_picture() {
  local file="$root/src/fur/$1"
  [[ -s "$file" ]] || fail "the demo did not write $1"
  [[ "$(head -c 8 "$file" | od -An -tx1 | tr -d ' \n')" == 89504e470d0a1a0a ]] || fail "$1 is no PNG"
}

timed() {
  local start=$SECONDS what="$1"
  shift
  "$@"
  echo "prove_packages: $what took $((SECONDS - start)) s"
}

if [[ -n "$(ls -A "$root")" && ! -f "$list_used" ]]; then
  fail "$root is not empty and no tree of this script: choose another --root, or empty it"
fi
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
if [[ $reuse == yes ]] && cmp -s "$repo/tools/packages.txt" "$list_used"; then
  echo "prove_packages: reusing $root"
else
  timed "debootstrap" make_tree
fi
mount_all
copy_sources
timed "tools/setup.sh" inside "tools/setup.sh"
if [[ $setup_only == no ]]; then
  timed "tools/demo.sh" inside "tools/demo.sh"
  check_picture out/demo.vulkan.png
  check_picture out/demo.gl.png
  echo "prove_packages: both pictures were written with nothing installed but tools/packages.txt"
fi
if [[ $tests == yes ]]; then timed "tools/test.sh" inside "tools/test.sh"; fi
