#!/usr/bin/env bash
# Builds and runs every test on Debian 13, in a root folder made from this machine's Debian package sources.
#   scripts/debian13.sh [-C FOLDER] [COMMAND...]
# COMMAND runs there instead of scripts/test.sh, in the repository's folder (scripts/demo.sh, bash, ...). FOLDER
# (build/debian13) keeps the root folder and the build for the next call: 4 GB. Needs root, for chroot.
# HYBRID_SLAM_DATASETS, HYBRID_SLAM_PRESET and HYBRID_SLAM_WERROR as for scripts/test.sh.
source "$(dirname "$0")/lib.sh"
release=trixie folder=build/debian13
if [[ ${1:-} == -C ]]; then folder=${2:?FOLDER is missing}; shift 2; fi
[[ ${1:-} != -* ]] || { echo "error: unknown option $1, expected -C FOLDER" >&2; exit 2; }
[[ $# -gt 0 ]] || set -- scripts/test.sh
[[ $EUID -eq 0 ]] || { echo "error: root is needed to work in another root folder (chroot)" >&2; exit 1; }

install_packages mmdebstrap debian-archive-keyring
mkdir -p "$folder"/{build,ccache}
folder=$(realpath "$folder") root=$folder/root

if [[ ! -d $root ]]; then
  echo "Making a Debian 13 root folder in $root"
  rm -rf "$root.part"
  debian_sources "$release" | mmdebstrap --quiet --variant=minbase --include=ca-certificates "$release" "$root.part" -
  mv "$root.part" "$root"
fi

environment=(HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin CCACHE_DIR=/ccache
  "HYBRID_SLAM_PRESET=${HYBRID_SLAM_PRESET:-release}" "HYBRID_SLAM_WERROR=${HYBRID_SLAM_WERROR:-}")
datasets=${HYBRID_SLAM_DATASETS:+$(realpath "$HYBRID_SLAM_DATASETS")}
[[ -z $datasets ]] || environment+=("HYBRID_SLAM_DATASETS=/datasets")

# Only this command sees the mounts, which end with it. Its build folder takes the place of this machine's.
inside() {
  set -euo pipefail
  mkdir -p "$root"/{repository,ccache,datasets} build
  mount --bind . "$root/repository"
  mount --bind "$folder/build" "$root/repository/build"
  mount --bind "$folder/ccache" "$root/ccache"
  [[ -z $datasets ]] || mount --bind -o ro "$datasets" "$root/datasets"
  for system in proc sys dev; do mount --rbind "/$system" "$root/$system"; done
  cat /etc/resolv.conf >"$root/etc/resolv.conf"
  cat /etc/hosts >"$root/etc/hosts"
  exec chroot "$root" env -i "${environment[@]}" env -C /repository "$@"
}
unshare --mount --propagation private bash -c \
  "$(declare -p root folder datasets environment); $(declare -f inside); inside \"\$@\"" - "$@"
