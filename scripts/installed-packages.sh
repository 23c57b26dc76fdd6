#!/usr/bin/env bash
# Called by scripts/test-packages.sh in a bare root folder: installs the packages beside this script, maps, removes them.
set -euo pipefail
cd "$(dirname "$0")"
fail() { echo "error: $*" >&2; exit 1; }
apt_get() { apt-get -q -y -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-unsafe-io "$@" >apt.log 2>&1 || { tail -n 40 apt.log >&2; fail "apt-get $*"; }; }
apt_get update

echo "== from a bare system to a map"
apt_get install --no-install-recommends ./hybrid-slam_*.deb ./libhybrid-slam0*.deb
(cd /root && hybrid-slam -q datasets/csie/csie-corridor.rawlog -o map)
[[ -s /root/map/map.png ]] || fail "no map"

echo "== programs, pages, settings"
apt_get install --no-install-recommends ./hybrid-slam-gui_*.deb
for package in hybrid-slam hybrid-slam-gui; do
  for program in $(dpkg -L $package | sed -n 's|^/usr/bin/||p'); do
    "$program" --version | grep -qE "^$program [0-9.]+$" || fail "$program --version"
    for page in $("$program" --help | grep -oE '[^ (]*doc/[a-z0-9-]+\.md'); do
      [[ $page == /usr/share/doc/hybrid-slam/doc/* && -f $page ]] || fail "$program --help names $page"
    done
    gzip -dc "/usr/share/man/man1/$program.1.gz" | grep -q "^.SH OPTIONS" || fail "no man page of $program"
    [[ -e /usr/share/bash-completion/completions/$program ]] || fail "no completion of $program"
  done
done
(cd /root && simul-floorplan -q config-ini/simul-csie-corridor.ini -o robot.rawlog)
(cd /root && hybrid-slam -q config-ini/csie-lms100.ini robot.rawlog -o paper)
loaded=$(LD_PRELOAD=libhybrid_slam_mrpt_plugin.so.0.1 /bin/true 2>&1)
[[ -z $loaded ]] || fail "the plugin for MRPT's programs: $loaded"
(hybrid-slam /dev/null 2>&1 || true) | grep -q "error: " || fail "no error"

echo "== completion"
apt_get install --no-install-recommends bash-completion
options=$(bash -c '
  source /usr/share/bash-completion/bash_completion
  source /usr/share/bash-completion/completions/slam-merge
  COMP_LINE="slam-merge --o" COMP_POINT=14 COMP_WORDS=(slam-merge --o) COMP_CWORD=1
  _hybrid_slam slam-merge --o slam-merge
  echo "${COMPREPLY[@]}"')
[[ $options == *--output* ]] || fail "slam-merge --o completes to '$options'"

echo "== dependencies of the development package"
apt_get install --simulate ./libhybrid-slam-dev_*.deb

echo "== removal"
mapfile -t installed < <(dpkg-query -W -f '${Package}\n' '*hybrid-slam*')
apt_get purge "${installed[@]}"
left=$(find / -xdev -iname '*hybrid*slam*' -not -path '/packages/*' -not -path '/root/*')
[[ -z $left ]] || fail "left after the removal: $left"
