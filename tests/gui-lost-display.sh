#!/usr/bin/env bash
# The window ends with a message and exit code 1 when its X server is gone, and does not hang.
#   tests/gui-lost-display.sh PROGRAM LOG
set -euo pipefail
command -v Xvfb >/dev/null || { echo "skipped: no screen: Xvfb is missing (Debian: xvfb)"; exit 77; }
folder=$(mktemp -d)
server="" window=""
# shellcheck disable=SC2086
trap 'kill $server $window 2>/dev/null || true; rm -rf "$folder"' EXIT
fail() { echo "error: $*"; cat "$folder"/{server,window}; exit 1; }
touch "$folder"/{server,window}

mkfifo "$folder/number"
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$folder/number" >"$folder/server" 2>&1 & server=$!
read -r display <"$folder/number" || fail "Xvfb does not start"
# timeout passes the exit code and the signals on.
env NO_AT_BRIDGE=1 GTK_A11Y=none GDK_BACKEND=x11 XDG_CONFIG_HOME="$folder/config" DISPLAY=":$display" \
  timeout -k 5 120 "$1" "$2" >"$folder/window" 2>&1 & window=$!
until [[ -e $folder/config/hybrid-slam-gui.conf ]]; do  # the window has opened the log
  kill -0 "$window" 2>/dev/null || fail "the window has ended before"
  sleep 0.1
done

kill "$server"
code=0
wait "$window" || code=$?
window=""
[[ $code -eq 1 ]] || fail "exit code $code without an X server (124: it hangs), expected 1"
grep -qx "hybrid-slam-gui: error: the X server has closed the connection" "$folder/window" || fail "no message names the X server"
