#!/usr/bin/env bash
# Tests the packages: lintian, and in a bare Debian root folder install, map, open the window, run the commands of the
# installed pages, build the C++ example, remove.
#   scripts/test-packages.sh [RELEASE [FOLDER]]
# RELEASE is bookworm or trixie (this machine's by default), FOLDER holds its packages (build/packages, of
# scripts/package.sh). build/RELEASE.tar keeps the bare root for the next call. Needs root, for chroot.
source "$(dirname "$0")/lib.sh"
here=$(. /etc/os-release && echo "$VERSION_CODENAME")
release=${1:-$here} folder=${2:-build/packages}
[[ $EUID -eq 0 ]] || { echo "error: root is needed to work in another root folder (chroot)" >&2; exit 1; }
folder=$(realpath "$folder")
install_packages mmdebstrap debian-archive-keyring lintian

echo "== lintian"
lintian --fail-on error,warning "$folder"/*.deb

echo "== a bare root folder of $release"
bare=build/$release.tar
if [[ ! -f $bare ]]; then
  mkdir -p build
  debian_sources "$release" | mmdebstrap --quiet --variant=apt --include=ca-certificates --format=tar \
    "$release" "$bare.part" -
  mv "$bare.part" "$bare"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/root"
tar -C "$work/root" -xf "$bare" --exclude='./dev/*'
inside=$work/root/packages
install -D -t "$inside" "$folder"/*.deb scripts/installed-packages.sh tests/{with-display,gui-signal}.sh
cp -r tests/consumer "$inside"
# The commands of the installed pages run there: what runs them, and the pages' own command that installs the packages.
mkdir "$inside/project"
cp --parents -t "$inside/project" scripts/check-docs.py tests/robot.sh tests/rawlog-to-bag.py
sed -nE 's/^sudo (apt install [^#]*[^# ]) *(#.*)?$/\1/p' README.md doc/first-map.md | sort -u >"$inside/install.sh"
[[ $(wc -l <"$inside/install.sh") -eq 1 ]] || { echo "error: README.md and first-map.md install differently"; exit 1; }

# Only this command sees the mounts, which end with it.
# shellcheck disable=SC2016
unshare --mount --propagation private bash -euc '
  root=$1
  for system in proc sys dev; do mount --rbind "/$system" "$root/$system"; done
  cat /etc/resolv.conf >"$root/etc/resolv.conf"
  cat /etc/hosts >"$root/etc/hosts"
  exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    DEBIAN_FRONTEND=noninteractive /packages/installed-packages.sh' - "$work/root"
echo "The packages of $release install, map, open the window, build the C++ example, and are removed."
