#!/usr/bin/env bash
# Throughput and latency of hybrid-slam-live on the simulated CSIE building: 541 beams, 50 particles, 5 cm, two threads.
#   scripts/live-benchmark.sh [MINUTES [RATE...]]
# Replays a log of MINUTES (10) at each RATE in cycles per second; 0: real time, 5 (0 10 20 40 80). Prints latency,
# skipped and lost cycles, and whether replaying the recording gives identical results.
source "$(dirname "$0")/lib.sh"
minutes=${1:-10}
shift || true
rates=("$@")
[[ $# -eq 0 ]] && rates=(0 10 20 40 80)
bin=$PWD/build/release/bin
work=$(mktemp -d)
server=
trap '[[ -n $server ]] && kill "$server" 2>/dev/null; rm -rf "$work"' EXIT

"$bin/simul-floorplan" config-ini/simul-csie.ini -q -o "$work/csie.rawlog" --set simulation.scans=$((minutes * 300))

# run RATE: 0: real time. Runs only one observation-server and one hybrid-slam-live at a time.
run() {
  local rate=$1 out=$work/out-$1
  printf '[server]\nport = 0\nrawlog = %s\nreplay_rate = %s\nwait_for_clients = 1\n' "$work/csie.rawlog" "$rate" \
    >"$work/server.ini"
  rm -f "$work/server.out"  # the previous run's file names another port
  "$bin/observation-server" "$work/server.ini" >"$work/server.out" 2>"$work/server.err" &
  server=$!
  local address=
  until address=$(sed -n 's/^listening at \(.*:[0-9]\)/\1/p' "$work/server.out" 2>/dev/null) && [[ -n $address ]]; do
    kill -0 "$server" || { cat "$work/server.err" >&2; exit 1; }
    sleep 0.1
  done
  "$bin/hybrid-slam-live" config-ini/csie-lms100.ini --server "$address" -o "$out" -n 50 -j 2 -q \
    2>"$work/live.err" || { cat "$work/live.err" "$work/server.err" >&2; exit 1; }
  wait "$server" || { cat "$work/server.err" >&2; exit 1; }
  server=
  "$bin/hybrid-slam" config-ini/csie-lms100.ini "$out"/recording-*.rawlog -o "$out-again" -n 50 -j 2 -q
  local same=differs
  cmp -s "$out/trajectory.tum" "$out-again/trajectory.tum" && same=same
  python3 - "$out/metrics.json" "$rate" "$same" <<'PYTHON'
import json, sys
m = json.load(open(sys.argv[1]))
l = m["latency_ms"]
print("| %s | %d | %d | %d | %.1f | %.1f | %.1f | %.0f | %s |" % (
    "5 (own pace)" if sys.argv[2] == "0" else sys.argv[2], m["scans"], m["skipped"], m["lost_cycles"],
    l["median"], l["p99"], l["max"], m["cpu_s"], sys.argv[3]))
PYTHON
}

echo "| cycles/s | scans | skipped | lost | median (ms) | p99 (ms) | max (ms) | CPU (s) | replay |"
echo "|---|---|---|---|---|---|---|---|---|"
for rate in "${rates[@]}"; do run "$rate"; done
