#!/usr/bin/env bash
# The default command on large random worlds: tables of doc/accuracy.md.
#   scripts/large-worlds.sh office|campus [OUT]     OUT defaults to out/office or out/campus
# An office is a building whose crossings look alike (scripts/make-office.py), a campus is outdoors
# (scripts/make-campus.py). WORLDS=12 of them from FIRST=228 on (office: 227, campus: eight others were used for tuning),
# VARIANTS "default no-lines" (also no-closing, and small-cells of 0.05 m), JOBS at a time (all cores). Resumes after an
# interruption. Takes half an hour of one core.
source "$(dirname "$0")/lib.sh"
world=${1:?office or campus}
out=${2:-out/$world}
bin=build/release/bin
install_packages "${packages[@]}"
build release simul-floorplan hybrid-slam slam-eval
mkdir -p "$out"

# run NUMBER VARIANT: a row: ATE (m), verdict, whether a second run was needed, CPU time (s).
run() {
  local log=$out/$world-$1 result=$out/$world-$1-$2 options=()
  [[ ! -f $result.row ]] || return 0
  case $2 in
    no-lines) options=(-m general) ;;
    no-closing) options=(--set loop_closing.enabled=false) ;;
    small-cells) options=(--set grid.resolution=0.05) ;;
  esac
  local TIMEFORMAT=%U seconds
  seconds=$({ time "$bin/hybrid-slam" "$log.rawlog" -q --overwrite -o "$result" "${options[@]}" >"$result.out" \
    2>"$result.log"; } 2>&1)
  "$bin/slam-eval" ate --trajectory "$result/trajectory.tum" --reference "$log.tum" >"$result.json"
  python3 - "$result" "$seconds" <<'END' >"$result.part"
import json, sys
result, seconds = sys.argv[1:]
metrics = json.load(open(result + "/metrics.json"))
error = json.load(open(result + ".json"))["trans_rmse_m"]
print(error, metrics["verdict"], int("second run" in open(result + ".log").read()), seconds)
END
  mv "$result.part" "$result.row"
}
export -f run
export out bin world
read -ra variants <<<"${VARIANTS:-default no-lines}"
for ((number = ${FIRST:-228}; number < ${FIRST:-228} + ${WORLDS:-12}; ++number)); do
  log=$out/$world-$number
  [[ -f $log.rawlog ]] ||
    { "scripts/make-$world.py" "$number" "$out" && "$bin/simul-floorplan" -q "$log.ini" -o "$log.rawlog"; }
  for variant in "${variants[@]}"; do echo "$number $variant"; done
done | xargs -P "${JOBS:-$(nproc)}" -L 1 bash -ec 'run "$@"' run

python3 - "$world" "$out" "${FIRST:-228}" "${WORLDS:-12}" "${variants[@]}" <<'END'
import collections, statistics, sys
world, out, first, worlds, *variants = sys.argv[1:]
print(f"<!-- made by: scripts/large-worlds.sh {world} -->")
print("| | error, median (worst), m | lost | verdicts | second runs | time (s) |")
print("|---|---|---|---|---|---|")
for variant in variants:
    numbers = range(int(first), int(first) + int(worlds))
    rows = [open(f"{out}/{world}-{number}-{variant}.row").read().split() for number in numbers]
    errors = [float(row[0]) for row in rows]
    verdicts = collections.Counter(row[1] for row in rows)
    lost = sum(error > 5 for error in errors)
    name = variant.replace("-", " ")
    print(f"| {name} | {statistics.median(errors):.2f} ({max(errors):.2f}) | {lost} of {len(rows)} | "
          + ", ".join(f"{count} {verdict}" for verdict, count in sorted(verdicts.items()))
          + f" | {sum(row[2] == '1' for row in rows)} | {statistics.mean(float(row[3]) for row in rows):.0f} |")
END
