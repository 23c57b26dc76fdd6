#!/usr/bin/env bash
# A stop signal ends the window (the program named as argument) with exit code 0, unlike a kill.
handled=$((1 << 0 | 1 << 1 | 1 << 14))  # SIGHUP, SIGINT, SIGTERM in the mask of /proc
for signal in TERM INT HUP; do
  env --default-signal=HUP "$1" & pid=$!  # under nohup it would ignore SIGHUP
  until (((0x$(sed -n 's/^SigCgt:[[:blank:]]*//p' "/proc/$pid/status") & handled) == handled)); do
    kill -0 "$pid" || exit 1
    sleep 0.1
  done
  kill -s "$signal" "$pid"
  wait "$pid" || { echo "exit code $? after SIG$signal"; exit 1; }
done
