#!/usr/bin/env bash
# MRPT's viewers load the plugin with the option of doc/mrpt-plugin.md.
#   tests/viewers.sh PLUGIN
set -euo pipefail
plugin=$1
for program in xvfb-run xauth RawLogViewer SceneViewer3D; do
  command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
folder=$(mktemp -d)
run=
trap '[[ -z $run ]] || kill $run 2>/dev/null; rm -rf "$folder"' EXIT
for viewer in RawLogViewer SceneViewer3D; do
  log=$folder/$viewer
  # The loader of the system writes what it loads. The viewers do not end by themselves.
  env HOME="$folder" TMPDIR="$folder" NO_AT_BRIDGE=1 LD_DEBUG=files \
    timeout -k 5 120 xvfb-run -a $viewer --load "$plugin" >"$log" 2>&1 &
  run=$!
  until grep -qF "calling init: $plugin" "$log"; do
    if ! kill -0 $run 2>/dev/null || grep "Error loading" "$log"; then
      echo "error: $viewer has not loaded $plugin"
      exit 1
    fi
    sleep 0.2
  done
  kill $run
  wait $run || true
  run=
done
