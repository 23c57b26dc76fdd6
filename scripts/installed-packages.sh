#!/usr/bin/env bash
# Called by scripts/test-packages.sh in a bare root folder: installs the packages beside this script, maps, starts the
# window, runs the commands of the installed pages, builds the C++ example, removes them. Beside it are also consumer
# (tests/consumer), with-display.sh and gui-signal.sh of tests/, install.sh (the pages' command that installs the
# packages) and project (scripts/check-docs.py and what it needs).
set -euo pipefail
cd "$(dirname "$0")"
fail() { echo "error: $*" >&2; exit 1; }
apt_get() {
  apt-get -q -y -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-unsafe-io "$@" >apt.log 2>&1 ||
    { tail -n 40 apt.log >&2; fail "apt-get $*"; }
}
# good_map FOLDER POSES: results of a run that mapped a whole log well
good_map() {
  local poses
  poses=$(wc -l <"$1/trajectory.tum")
  [[ -s $1/map.png && $poses -eq $2 ]] || fail "$1: $poses poses, expected a map and $2 poses"
  grep -q '"verdict": "consistent"' "$1/metrics.json" || fail "$1: $(grep '"verdict"' "$1/metrics.json")"
}
# pages PAGE...: runs the commands of installed pages in empty folders, /root/trial/PAGE
pages() {
  python3 project/scripts/check-docs.py --keep /root/trial --commands /usr "$@" || fail "commands of the pages"
}
apt_get update

echo "== from a bare system to a map"
apt_get install --no-install-recommends ./hybrid-slam_*.deb ./libhybrid-slam[0-9]*.deb
(cd /root && hybrid-slam -q datasets/csie/csie-corridor.rawlog -o map)
scans=$(wc -l </usr/share/hybrid_slam/datasets/csie/csie-corridor.tum)
good_map /root/map "$scans"

echo "== a new user's trial with the installed pages: a bag of a drive, live runs; and a CARMEN log"
apt_get install --no-install-recommends python3
ln -s /usr/share/doc/hybrid-slam/{README.md,doc} project
pages first-map.md own-log.md own-robot.md live.md
for name in robot coarse again tuesday wednesday; do good_map "/root/trial/own-log/$name" "$scans"; done
good_map /root/trial/own-robot/again "$scans"
# 40 scans of a robot that drives 4 m straight, in a room of 8 m x 6 m.
awk 'BEGIN {
  for (scan = 0; scan < 40; ++scan) {
    x = 0.1 * scan
    printf "FLASER 181"
    for (angle = -90; angle <= 90; ++angle) {
      ahead = cos(angle * 3.14159265 / 180) / (8 - x)
      aside = sin(angle * 3.14159265 / 180) / 3
      if (aside < 0) aside = -aside
      printf " %.3f", 1 / (ahead > aside ? ahead : aside)
    }
    printf " %s 0 0 %s 0 0 %s robot %s\n", x, x, scan, scan
  }
}' >/root/trial/robot.clf
(cd /root/trial && hybrid-slam -q robot.clf -o carmen)
good_map /root/trial/carmen 40

echo "== programs, pages, settings"
mkdir build
ln -s /packages build/packages
# The pages' command; the user's apt asks.
apt() { apt_get --no-install-recommends "$@"; }
source ./install.sh
mapfile -t names < <(dpkg-query -W -f '${Package}\n' '*hybrid-slam*')
[[ -x /usr/bin/hybrid-slam-gui ]] || fail "the pages' command does not install the window"
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
subcommands=$(slam-eval --help | sed -n '/^Subcommands:/,$ s/^  \([^ ]\+\).*/\1/p')
[[ $subcommands == *nees-relations* ]] || fail "slam-eval --help lists the subcommands '$subcommands'"
page=$(gzip -dc /usr/share/man/man1/slam-eval.1.gz)
for subcommand in $subcommands; do
  grep -qE "^\.S[HS] \"Subcommand $subcommand:\"" <<<"$page" || fail "man slam-eval: no heading of $subcommand"
done
(cd /root && simul-floorplan -q config-ini/simul-csie-corridor.ini -o robot.rawlog)
(cd /root && hybrid-slam -q config-ini/csie-lms100.ini robot.rawlog -o paper)
(hybrid-slam /dev/null 2>&1 || true) | grep -q "error: " || fail "no error"

echo "== nothing is linked that is not used"
for file in $(dpkg -L "${names[@]}" | grep -E '^/usr/(bin|lib)/.'); do
  [[ -f $file && ! -L $file ]] || continue
  unused=$(ldd -u "$file" 2>&1) || fail "$file: $unused"
done

echo "== the window, and its entry in the desktop's menu"
apt_get install --no-install-recommends xvfb xauth openbox libgl1-mesa-dri desktop-file-utils shared-mime-info
./with-display.sh ./gui-signal.sh hybrid-slam-gui || fail "the window does not open, or does not end"
entry=/usr/share/applications/hybrid-slam-gui.desktop
desktop-file-validate $entry || fail "$entry"
value() { sed -n "s/^$1=//p" $entry; }
command -v "$(value Exec | cut -d ' ' -f 1)" >/dev/null || fail "$entry starts no program"
[[ -s /usr/share/icons/hicolor/scalable/apps/$(value Icon).svg ]] || fail "no icon $(value Icon)"
for type in $(value MimeType | tr ';' ' '); do
  [[ -f /usr/share/mime/$type.xml ]] || fail "$entry: no files are of type $type"
  grep -q "^$type=.*hybrid-slam-gui.desktop" /usr/share/applications/mimeinfo.cache || fail "$type opens no window"
done

echo "== MRPT's programs and log: README.md, slam-compare, the plugin, rawlog-edit"
apt_get install --no-install-recommends mrpt-apps mrpt-common
rm -r /root/trial
pages README.md slam-compare.md mrpt-plugin.md own-log.md

echo "== completion"
apt_get install --no-install-recommends bash-completion zsh
# completes COMMAND EXPECTED: whether the last word of the command line completes to the word, in bash and in zsh
completes() {
  local words shell found
  read -ra words <<<"$1"
  for shell in bash zsh; do
    found=$("${shell}_completions" "${words[@]}")
    [[ $'\n'$found$'\n' == *$'\n'$2$'\n'* ]] || fail "$1 completes to '$found' in $shell, expected $2"
  done
}
bash_completions() {
  # shellcheck disable=SC2016
  bash -c '
    source /usr/share/bash-completion/bash_completion
    source "/usr/share/bash-completion/completions/$1"
    COMP_LINE=$* COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    COMP_POINT=${#COMP_LINE}
    _hybrid_slam "$1" "${@: -1}" "${@: -2:1}"
    printf "%s\n" "${COMPREPLY[@]}"' - "$@"
}
zsh_completions() {
  # shellcheck disable=SC2016
  zsh -fc '
    autoload -U _hybrid-slam
    compadd() { print -rl -- ${(M)${(P)2}:#$PREFIX*} }           # called as compadd -a ARRAY
    _describe() { print -rl -- ${(M)${${(P)2}%%:*}:#$PREFIX*} }  # called as _describe WHAT ARRAY
    words=("$@") CURRENT=$# PREFIX=${@[-1]}
    _hybrid-slam' - "$@"
}
completes "slam-merge --o" --output
completes "slam-eval nees-" nees-relations
completes "slam-eval nees-relations --n" --noise-deg

echo "== what the pages and the window call is recommended or suggested"
for needed in hybrid-slam:rawlog-edit:mrpt-apps hybrid-slam-gui:xdg-open:xdg-utils; do
  IFS=: read -r package program from <<<"$needed"
  dpkg-query -W -f '${Recommends}, ${Suggests}\n' "$package" | grep -qw "$from" ||
    fail "$package names no package that has $program"
done

echo "== a C++ project with the development package alone"
apt_get install --no-install-recommends ./libhybrid-slam-dev_*.deb g++ cmake make
cmake -S consumer -B /root/consumer >cmake.log 2>&1 || { cat cmake.log >&2; fail "cmake"; }
cmake --build /root/consumer
/root/consumer/consumer /usr/share/hybrid_slam/datasets/csie/csie-corridor.rawlog | grep '^pose .* lines$' ||
  fail "tests/consumer printed no pose"

echo "== removal"
mapfile -t installed < <(dpkg-query -W -f '${Package}\n' '*hybrid-slam*')
apt_get purge "${installed[@]}"
left=$(find / -xdev -iname '*hybrid*slam*' -not -path '/packages/*' -not -path '/root/*')
[[ -z $left ]] || fail "left after the removal: $left"
