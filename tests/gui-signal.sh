#!/usr/bin/env bash
# A stop signal ends the window (the program named as argument) with exit code 0, unlike a kill.
for signal in TERM INT; do
  "$1" & pid=$!
  until ((0x$(sed -n 's/^SigCgt:[[:blank:]]*//p' "/proc/$pid/status") >> 14 & 1)); do  # SIGTERM has a handler
    kill -0 "$pid" || exit 1
    sleep 0.1
  done
  kill -s "$signal" "$pid"
  wait "$pid" || { echo "exit code $? after SIG$signal"; exit 1; }
done
