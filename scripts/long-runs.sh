#!/usr/bin/env bash
# Measures what grows with laps, days and kilometres in long runs: the tables of doc/reliability.md.
#   scripts/long-runs.sh [laps | refinement | day | drive | drive100 ...]      default: all five
# HYBRID_SLAM_DATASETS names the folder with intel-lab.clf.gz (doc/datasets.md) for `laps` and `refinement`. The results and logs go to
# OUT (out/long-runs; 5 GB). HOURS (24) and RATE (2500 cycles/s) are those of `day`, KM and KM_LOOPS (with the
# default settings; both "1 2 5 10") those of `drive`. Each needs a quarter of an hour on a free core, `drive` half an hour.
source "$(dirname "$0")/lib.sh"
if [[ $# -eq 0 && -z ${HYBRID_SLAM_DATASETS:-} ]]; then
  echo "HYBRID_SLAM_DATASETS is unset: no laps, no refinement" >&2
  set -- day drive drive100
fi
[[ $# -gt 0 ]] || set -- laps refinement day drive drive100
install_packages "${packages[@]}"
build release hybrid-slam hybrid-slam-live hybrid-slam-laps observation-server log2rawlog simul-floorplan >&2
bin=$PWD/build/release/bin
config=$PWD/config-ini
out=${OUT:-out/long-runs}
mkdir -p "$out"
out=$(cd "$out" && pwd)

# metric KEY FOLDER: a number of metrics.json.
metric() { awk -F'[:,]' -v key="\"$1\"" '$1 ~ key { print $2; exit }' "$2/metrics.json"; }
megabytes() { awk '{ s += $1 } END { printf "%.1f", s / 1e6 }' < <(stat -Lc %s "$@" 2>/dev/null); }

# laps_of N: the Intel log driven forwards and backwards in turn.
laps_of() {
  [[ -e $out/intel.rawlog ]] ||
    "$bin/log2rawlog" "$HYBRID_SLAM_DATASETS/intel-lab.clf.gz" "$out/intel.rawlog" >/dev/null
  "$bin/hybrid-slam-laps" "$out/intel.rawlog" "$1" "$out/intel-$1.rawlog"
}

laps() {
  echo "| laps | scans | CPU (s) | CPU per lap (s) | peak memory (MB) | session (MB) |"
  echo "|---|---|---|---|---|---|"
  local n
  for n in 1 2 5 10; do
    laps_of "$n"
    "$bin/hybrid-slam" "$config/paper.ini" "$out/intel-$n.rawlog" -q --overwrite -j 1 -o "$out/laps-$n"
    awk -v n="$n" -v scans="$(metric scans "$out/laps-$n")" -v cpu="$(metric cpu_s "$out/laps-$n")" \
      -v peak="$(metric peak_rss_mb "$out/laps-$n")" -v session="$(megabytes "$out/laps-$n/session.hslam")" \
      'BEGIN { printf "| %d | %d | %.0f | %.1f | %.0f | %s |\n", n, scans, cpu, cpu / n, peak, session }'
  done
}

# Peak memory with and without the refinement, which holds all scans: about 600 bytes for a scan, and 9 for each of its
# 181 beams (FilterRun::limitRefinement).
refinement() {
  echo "| laps | scans | not refined (MB) | refined (MB) | difference (MB) | estimate (MB) |"
  echo "|---|---|---|---|---|---|"
  local n refine
  for n in 1 5 10; do
    laps_of "$n"
    for refine in 0 1; do
      "$bin/hybrid-slam" "$config/paper.ini" "$out/intel-$n.rawlog" -q --overwrite -j 1 --set run.refine=$refine \
        -o "$out/refinement-$n-$refine"
    done
    awk -v n="$n" -v scans="$(metric scans "$out/refinement-$n-1")" \
      -v without="$(metric peak_rss_mb "$out/refinement-$n-0")" -v with="$(metric peak_rss_mb "$out/refinement-$n-1")" \
      'BEGIN { printf "| %d | %d | %.0f | %.0f | %.0f | %.0f |\n", n, scans, without, with, with - without,
               scans * (600 + 9 * 181) / 2^20 }'
  done
}

# A robot drives laps in the simulated CSIE building, with 40 scans and odometry readings per second of robot time, sent
# as fast as one core can process them.
day() {
  local hours=${HOURS:-24} rate=${RATE:-2500} seconds server live address
  "$bin/simul-floorplan" "$config/simul-csie.ini" -q -o "$out/round.rawlog" --set laser.sensor=LMS-200 \
    --set laser.resolution_deg=1 --set laser.rate=40 --set odometry.rate=40
  seconds=$(awk 'NR == 1 { first = $1 } { last = $1 } END { print int(last - first) }' "$out/round.tum")
  "$bin/hybrid-slam-laps" "$out/round.rawlog" $(((hours * 3600 + seconds - 1) / seconds)) "$out/day.rawlog"
  printf '[server]\nport = 0\ncycle_rate = 0\nqueue = 20000\nrawlog = %s\nreplay_rate = %s\nwait_for_clients = 1\n' \
    "$out/day.rawlog" "$rate" >"$out/server.ini"
  cp "$config/csie-lms100.ini" "$out/live.ini"
  printf '\n[live]\nmax_waiting = 20000\n' >>"$out/live.ini"
  rm -f "$out/server.out"  # that of an earlier run names another port
  "$bin/observation-server" "$out/server.ini" >"$out/server.out" 2>"$out/server.err" &
  server=$!
  until address=$(sed -n 's/^listening at \(.*:[0-9]\)/\1/p' "$out/server.out" 2>/dev/null) && [[ -n $address ]]; do
    kill -0 "$server" || { cat "$out/server.err" >&2; exit 1; }
    sleep 0.5
  done
  rm -rf "$out/day"
  "$bin/hybrid-slam-live" "$out/live.ini" --server "$address" -j 1 -o "$out/day" --checkpoint-every 30 \
    >"$out/live.out" 2>"$out/live.err" &
  live=$!
  local scans next=0 rss
  echo "| robot time (h) | scans | wall (s) | memory (MB) | recording (MB) | session (MB) |"
  echo "|---|---|---|---|---|---|"
  SECONDS=0
  while kill -0 "$live" 2>/dev/null; do
    sleep 2
    scans=$(sed -n "s/.*filter: \([0-9]*\) scans, .*/\1/p" "$out/live.err" | tail -1)
    [[ ${scans:-0} -ge $next ]] || continue
    rss=$(awk '/VmRSS/ { print $2 / 1024 }' "/proc/$live/status" 2>/dev/null) || continue
    awk -v scans="${scans:-0}" -v rss="${rss:-0}" -v s=$SECONDS \
      -v recording="$(megabytes "$out"/day/.partial.recording-*)" -v session="$(megabytes "$out/day/session.hslam")" \
      'BEGIN { printf "| %.1f | %d | %d | %.0f | %.0f | %s |\n", scans / 144000, scans, s, rss, recording, session }'
    next=$((${scans:-0} + 144000 * hours / 8))
  done
  wait "$live" || { tail -3 "$out/live.err" >&2; exit 1; }
  wait "$server"
  echo
  tail -2 "$out/live.out"
  grep -E '"(scans|updates|skipped|lost_cycles|peak_rss_mb|wall_s|distance_m)"' "$out/day/metrics.json"
}

# floor_of KM [RATE]: RATE (5) scans per second and metre; lanes of 500 m in a building, each entered from the end of the one before; pillars at irregular places.
floor_of() {
  awk -v lanes=$((2 * $1)) -v plan="$out/drive-$1.plan" -v route="$out/drive-$1.route" 'BEGIN {
    srand(1)
    print "rectangle 0 0 500", 5 * lanes > plan
    print "start 4 2.5 0\nspeed 1" > route
    for (i = 0; i < lanes; ++i) {
      y = 5 * i; ahead = i % 2 == 0
      if (i > 0) print "wall", (ahead ? 5 : 0), y, (ahead ? 500 : 495), y > plan
      for (x = 8 + 4 * rand(); x < 490; x += 3 + 5 * rand()) {
        side = rand() < 0.5 ? 0.1 : 4.3
        printf "rectangle %.2f %.2f %.2f %.2f\n", x, y + side, x + 0.3 + rand(), y + side + 0.6 > plan
      }
      last = i == lanes - 1
      printf "%s %s %s%s\n", last ? "go" : "via", ahead ? 497.5 : 2.5, y + 2.5, last ? "" : " 1" > route
      if (!last) printf "via %s %s 1\n", ahead ? 497.5 : 2.5, y + 7.5 > route
    }
  }'
  printf '[simulation]\nplan = drive-%s.plan\nroute = drive-%s.route\n' "$1" "$1" >"$out/drive-$1.ini"
  "$bin/simul-floorplan" "$out/drive-$1.ini" -q -o "$out/drive-$1.rawlog" --set laser.sensor=LMS-200 \
    --set laser.resolution_deg=1 --set laser.rate="${2:-5}" --set odometry.rate="${2:-5}"
}

# drive_row KM NAME OPTION...
drive_row() {
  local km=$1 name=$2 folder=$out/drive-$1-$2
  shift 2
  "$bin/hybrid-slam" "$@" "$out/drive-$km.rawlog" -q --overwrite -j 1 -o "$folder"
  awk -v km="$km" -v name="$name" -v scans="$(metric scans "$folder")" -v cpu="$(metric cpu_s "$folder")" \
    -v peak="$(metric peak_rss_mb "$folder")" -v session="$(megabytes "$folder/session.hslam")" \
    -v simple="$(megabytes "$folder/map.simplemap.gz")" -v all="$(megabytes "$folder"/*)" \
    'BEGIN { printf "| %s | %d | %d | %.1f | %.0f | %s | %s | %s |\n", name, km, scans, cpu / km, peak, session, simple, all }'
}

drive_head() {
  echo "| filter | km | scans | CPU per km (s) | peak memory (MB) | session (MB) | map.simplemap.gz (MB) | all results (MB) |"
  echo "|---|---|---|---|---|---|---|---|"
}

# Kilometres that the robot has never seen before, 5 scans a metre.
drive() {
  drive_head
  local km
  for km in ${KM:-1 2 5 10}; do
    floor_of "$km"
    drive_row "$km" paper "$config/csie-lms100.ini"
  done
  for km in ${KM_LOOPS:-1 2 5 10}; do
    floor_of "$km"
    drive_row "$km" default
  done
}

# 100 km, with two scans a metre.
drive100() {
  drive_head
  floor_of 100 2
  drive_row 100 paper "$config/csie-lms100.ini"
  drive_row 100 general "$config/csie-lms100.ini" -m general
}

for what in "$@"; do "$what"; done
