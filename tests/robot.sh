#!/usr/bin/env bash
# Sourced before the commands of the pages that need a robot (scripts/check-docs.py): observation-server replays a log
# instead of reading sensors, at a free port and in the background, and hybrid-slam-live reads from it. All other
# arguments are the page's. A run with checkpoints is killed after the first, as by a crash.

drive=$PREFIX/share/hybrid_slam/datasets/csie/csie-corridor.rawlog
address=

observation-server() {
  rm -f .server.out
  command observation-server "$@" --set server.rawlog="$drive" --set server.port=0 --set server.replay_rate=100 \
    --set server.wait_for_clients=1 >.server.out 2>.server.err &
  server=$!
  until address=$(sed -n 's/^listening at //p' .server.out) && [[ -n $address ]]; do
    kill -0 $server || { cat .server.err >&2; return 1; }
    sleep 0.1
  done
}

hybrid-slam-live() {
  [[ -n $address ]] || observation-server config-ini/observation-server.ini
  local arguments=("${@/%*:4550/$address}")
  [[ " $* " == *" --server "* ]] || arguments+=(--server "$address")
  if [[ " $* " == *" --checkpoint-every "* ]]; then
    kill-after-checkpoint "${arguments[@]}"
  else
    command hybrid-slam-live "${arguments[@]}"
  fi
  kill "$server" 2>/dev/null || true
  wait
  address=
}

# The page's period of the checkpoints is longer than the replay.
kill-after-checkpoint() {
  local all="$*" out run
  out=${all#* -o } out=${out%% *}
  command hybrid-slam-live "${@/#60/0.1}" &
  run=$!
  until [[ -f $out/session.hslam ]]; do
    kill -0 $run || { echo "error: the run ended before it saved a checkpoint" >&2; return 1; }
    sleep 0.1
  done
  kill -9 $run
  wait $run || true
}
