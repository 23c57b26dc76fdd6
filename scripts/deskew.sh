#!/usr/bin/env bash
# Simulated lasers that take time for a scan, on a robot that turns at 1.5 rad/s, with and without the correction: the
# chapter "Lasers that take time for a scan" of doc/experiments.md.
#   scripts/deskew.sh [OUT]     OUT defaults to out/deskew
# SEEDS="1 2 3 4 5" of the simulation and the filter; RATES="5 10 20 40" Hz. Prints the table: medians over the seeds.
# Resumes after an interruption. 15 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/deskew}
bin=build/release/bin
install_packages "${packages[@]}"
build release simul-floorplan hybrid-slam slam-eval
read -ra seeds <<<"${SEEDS:-1 2 3 4 5}"
read -ra rates <<<"${RATES:-5 10 20 40}"

# errors LOG RESULT SETTINGS...: one line, ATE (mm), its heading part (deg), error of a second's motion (mm, deg)
errors() {
  local log=$1 result=$2
  shift 2
  [[ -f $result/metrics.json ]] ||
    "$bin"/hybrid-slam config-ini/csie-lms100.ini "$log.rawlog" -q -s "$seed" "$@" -o "$result" \
      >"$result.log" 2>&1 || [[ -f $result/metrics.json ]]
  "$bin"/slam-eval ate --trajectory "$result/trajectory.tum" --reference "$log.tum" >"$result.ate"
  "$bin"/slam-eval rpe --trajectory "$result/trajectory.tum" --reference "$log.tum" --delta 1s >"$result.rpe"
  python3 - "$result" <<'PYTHON'
import json, sys
ate, rpe = (json.load(open(f"{sys.argv[1]}.{name}")) for name in ("ate", "rpe"))
print(1000 * ate["trans_rmse_m"], ate["rot_rmse_deg"], 1000 * rpe["trans_rmse_m"], rpe["rot_rmse_deg"])
PYTHON
}

mkdir -p "$out"
for rate in "${rates[@]}"; do
  rm -f "$out/$rate"-*.part
  scan_time=$(python3 -c "print(0.75 / $rate)") # 270 of 360 deg
  for seed in "${seeds[@]}"; do
    for kind in swept instant; do
      log=$out/$rate-$seed-$kind
      [[ -f $log.rawlog ]] || "$bin"/simul-floorplan config-ini/simul-csie-doorways.ini -q -s "$seed" \
        --set simulation.route=../datasets/csie/csie-turns.route --set laser.rate="$rate" \
        --set laser.scan_time="$([[ $kind == swept ]] && echo "$scan_time" || echo 0)" -o "$log.rawlog"
    done
    errors "$out/$rate-$seed-swept" "$out/$rate-$seed-without" --set input.scan_time=0 >>"$out/$rate-without.part"
    errors "$out/$rate-$seed-swept" "$out/$rate-$seed-with" >>"$out/$rate-with.part"
    errors "$out/$rate-$seed-instant" "$out/$rate-$seed-none" >>"$out/$rate-instant.part"
  done
  for kind in without with instant; do mv "$out/$rate-$kind.part" "$out/$rate-$kind.txt"; done
done

python3 - "$out" "${rates[@]}" <<'PYTHON'
import statistics, sys
out, rates = sys.argv[1], sys.argv[2:]
print("| rate | scan time | beams | ATE (mm) | heading (deg) | in 1 s (mm) | in 1 s (deg) |\n|---|---|---|---|---|---|---|")
names = {"without": "not corrected", "with": "corrected", "instant": "all at once"}
for rate in rates:
    for kind, name in names.items():
        runs = [list(map(float, line.split())) for line in open(f"{out}/{rate}-{kind}.txt")]
        a, b, c, d = (statistics.median(values) for values in zip(*runs))
        print(f"| {rate} Hz | {750 / float(rate):.1f} ms | {name} | {a:.0f} | {b:.2f} | {c:.1f} | {d:.2f} |")
PYTHON
