#!/usr/bin/env bash
# Runs the commands of doc/sessions.md on the CSIE logs, and regenerates its pictures.
#   scripts/sessions-demo.sh [OUT]     OUT defaults to out/sessions
source "$(dirname "$0")/lib.sh"
out=${1:-out/sessions}
build release hybrid-slam slam-merge >&2
PATH=$PWD/build/release/bin:$PATH
csie=datasets/csie
# Interrupted by Ctrl-C after a second, and resumed.
timeout -s INT 1 hybrid-slam -q --overwrite $csie/csie-loop.rawlog -o "$out/interrupted" || true
hybrid-slam -q --overwrite --resume "$out/interrupted/session.hslam" -o "$out/resumed"
hybrid-slam -q --overwrite $csie/csie-loop.rawlog -o "$out/monday"
cmp "$out/resumed/trajectory.tum" "$out/monday/trajectory.tum"
cp "$out/interrupted/map.png" doc/images/session-saved.png
cp "$out/resumed/map.png" doc/images/session-resumed.png
hybrid-slam -q --overwrite $csie/csie-doorways.rawlog --continue "$out/monday/session.hslam" -o "$out/tuesday"
hybrid-slam -q --overwrite $csie/csie-corridor.rawlog --localize "$out/monday/session.hslam" -o "$out/where"
hybrid-slam -q --overwrite $csie/csie-doorways.rawlog -o "$out/doorways"
slam-merge -q --overwrite "$out/monday/session.hslam" "$out/doorways/session.hslam" -o "$out/both"
cp "$out/tuesday/map.png" doc/images/session-continue.png
cp "$out/where/map.png" doc/images/session-localize.png
cp "$out/both/map.png" doc/images/session-merge.png
