#!/usr/bin/env bash
# Simulates lasers that take time for a scan, on a robot that turns at 1.5 rad/s, with and without the correction: the
# chapter "Lasers that take time for a scan" of doc/experiments.md.
#   scripts/deskew.sh [OUT]     OUT defaults to out/deskew
# SEEDS="1 2 3 4 5" of the simulation and the filter; RATES="5 10 20 40" Hz; SETTINGS=default runs without an INI file;
# ROUTE=straight is a drive of 25 m without turns; FACTORS="0.5 2" adds corrections with a multiple of the true scan time.
# Prints the table: medians over the seeds. Resumes after an interruption. 15 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/deskew}
bin=build/release/bin
install_packages "${packages[@]}"
build release simul-floorplan hybrid-slam slam-eval
read -ra seeds <<<"${SEEDS:-1 2 3 4 5}"
read -ra rates <<<"${RATES:-5 10 20 40}"
read -ra factors <<<"${FACTORS:-}"
settings=(config-ini/csie-lms100.ini)
[[ ${SETTINGS:-} != default ]] || settings=()
route=$PWD/datasets/csie/csie-turns.route
mkdir -p "$out/${SETTINGS:-paper}-${ROUTE:-turns}"
out=$(realpath "$out/${SETTINGS:-paper}-${ROUTE:-turns}")
if [[ ${ROUTE:-} == straight ]]; then
  route=$out/straight.route
  printf 'start 4.5 1.25 0\nspeed 0.67\ngo 29.5 1.25\n' >"$route"
fi

# errors LOG REFERENCE RESULT SETTINGS...: one line, ATE (mm), error of a second's motion (mm, deg)
errors() {
  local log=$1 reference=$2 result=$3
  shift 3
  [[ -f $result/metrics.json ]] ||
    "$bin"/hybrid-slam "${settings[@]}" "$log.rawlog" -q -s "$seed" "$@" -o "$result" \
      >"$result.log" 2>&1 || [[ -f $result/metrics.json ]]
  "$bin"/slam-eval ate --trajectory "$result/trajectory.tum" --reference "$reference" >"$result.ate"
  "$bin"/slam-eval rpe --trajectory "$result/trajectory.tum" --reference "$reference" --delta 1s >"$result.rpe"
  python3 - "$result" <<'PYTHON'
import json, sys
ate, rpe = (json.load(open(f"{sys.argv[1]}.{name}")) for name in ("ate", "rpe"))
print(1000 * ate["trans_rmse_m"], 1000 * rpe["trans_rmse_m"], rpe["rot_rmse_deg"])
PYTHON
}

# middle LOG: the truth in the middle of each scan, with the scan's timestamp.
middle() {
  python3 - "$1.tum" "$scan_time" <<'PYTHON'
import math, sys
rows = [list(map(float, line.split())) for line in open(sys.argv[1])]
half = float(sys.argv[2]) / 2
for a, b in zip(rows, rows[1:] + rows[-1:]):
    share = half / (b[0] - a[0]) if b[0] > a[0] else 0
    x, y = (p + share * (q - p) for p, q in zip(a[1:3], b[1:3]))
    phi, next_phi = (2 * math.atan2(row[6], row[7]) for row in (a, b))
    phi += share * math.remainder(next_phi - phi, 2 * math.pi)
    print(f"{a[0]:.6f} {x:.6f} {y:.6f} 0 0 0 {math.sin(phi / 2):.9f} {math.cos(phi / 2):.9f}")
PYTHON
}

for rate in "${rates[@]}"; do
  rm -f "$out/$rate"-*.part
  scan_time=$(python3 -c "print(0.75 / $rate)") # 270 of 360 deg
  for seed in "${seeds[@]}"; do
    for kind in swept instant; do
      log=$out/$rate-$seed-$kind
      [[ -f $log.rawlog ]] || "$bin"/simul-floorplan config-ini/simul-csie-doorways.ini -q -s "$seed" \
        --set "simulation.route=$route" --set laser.rate="$rate" \
        --set laser.scan_time="$([[ $kind == swept ]] && echo "$scan_time" || echo 0)" -o "$log.rawlog"
    done
    swept=$out/$rate-$seed-swept without=$out/$rate-$seed-without instant=$out/$rate-$seed-instant
    middle "$swept" >"$swept.middle.tum"
    errors "$swept" "$swept.tum" "$without" --set input.scan_time=0 >>"$out/$rate-without.part"
    errors "$swept" "$swept.middle.tum" "$without" >>"$out/$rate-middle.part"
    errors "$swept" "$swept.tum" "$out/$rate-$seed-with" >>"$out/$rate-with.part"
    errors "$instant" "$instant.tum" "$out/$rate-$seed-none" >>"$out/$rate-instant.part"
    for factor in "${factors[@]}"; do
      errors "$swept" "$swept.tum" "$out/$rate-$seed-times-$factor" \
        --set "input.scan_time=$(python3 -c "print($factor * $scan_time)")" >>"$out/$rate-times-$factor.part"
    done
  done
  for kind in without middle with instant "${factors[@]/#/times-}"; do mv "$out/$rate-$kind.part" "$out/$rate-$kind.txt"; done
done

python3 - "$out" "${FACTORS:-}" "${rates[@]}" <<'PYTHON'
import statistics, sys
out, factors, rates = sys.argv[1], sys.argv[2].split(), sys.argv[3:]
print("| rate | scan time | beams | ATE (mm) | worst (mm) | in 1 s (mm) | in 1 s (deg) |\n|---|---|---|---|---|---|---|")
names = {"without": "not corrected", "middle": "not corrected, against the middle", "with": "corrected", "instant": "all at once"}
names |= {f"times-{factor}": f"corrected with {factor} times the scan time" for factor in factors}
runs = {(rate, kind): [list(map(float, line.split())) for line in open(f"{out}/{rate}-{kind}.txt")] for rate in rates for kind in names}
for rate in rates:
    for kind, name in names.items():
        of_kind = runs[rate, kind]
        ate, shift, turn = (statistics.median(values) for values in zip(*of_kind))
        print(f"| {rate} Hz | {750 / float(rate):.1f} ms | {name} | {ate:.0f} | {max(run[0] for run in of_kind):.0f} | "
              f"{shift:.0f} | {turn:.2f} |")
print()
for rate in rates:
    worse = sum(a[2] > b[2] for a, b in zip(runs[rate, "with"], runs[rate, "without"]))
    print(f"{rate} Hz: the heading in 1 s is worse with the correction in {worse} of {len(runs[rate, 'with'])} runs")
PYTHON
