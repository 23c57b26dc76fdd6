#!/usr/bin/env bash
# The default command on random office buildings whose crossings look alike (scripts/make-office.py): the table of
# doc/accuracy.md.
#   scripts/offices.sh [OUT]     OUT defaults to out/offices
# BUILDINGS=12 of them from FIRST=228 on (227 was used for tuning), VARIANTS "default no-lines" (and no-closing), JOBS
# at a time (all cores). Resumes after an interruption. Takes half an hour of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/offices}
bin=build/release/bin
install_packages "${packages[@]}"
build release simul-floorplan hybrid-slam slam-eval
mkdir -p "$out"

# run BUILDING VARIANT: a row: ATE (m), verdict, whether a second run was needed, CPU time (s).
run() {
  local log=$out/office-$1 result=$out/office-$1-$2 options=()
  [[ ! -f $result.row ]] || return 0
  case $2 in
    no-lines) options=(-m general) ;;
    no-closing) options=(--set loop_closing.enabled=false) ;;
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
export out bin
read -ra variants <<<"${VARIANTS:-default no-lines}"
for ((building = ${FIRST:-228}; building < ${FIRST:-228} + ${BUILDINGS:-12}; ++building)); do
  log=$out/office-$building
  [[ -f $log.rawlog ]] ||
    { scripts/make-office.py "$building" "$out" && "$bin/simul-floorplan" -q "$log.ini" -o "$log.rawlog"; }
  for variant in "${variants[@]}"; do echo "$building $variant"; done
done | xargs -P "${JOBS:-$(nproc)}" -L 1 bash -ec 'run "$@"' run

python3 - "$out" "${variants[@]}" <<'END'
import collections, glob, statistics, sys
out, *variants = sys.argv[1:]
print("<!-- made by: scripts/offices.sh -->")
print("| | error, median (worst), m | lost | verdicts | second runs | time (s) |")
print("|---|---|---|---|---|---|")
for variant in variants:
    rows = [open(name).read().split() for name in glob.glob(f"{out}/*-{variant}.row")]
    errors = [float(row[0]) for row in rows]
    verdicts = collections.Counter(row[1] for row in rows)
    lost = sum(error > 5 for error in errors)
    name = variant.replace("-", " ")
    print(f"| {name} | {statistics.median(errors):.2f} ({max(errors):.2f}) | {lost} of {len(rows)} | "
          + ", ".join(f"{count} {verdict}" for verdict, count in sorted(verdicts.items()))
          + f" | {sum(row[2] == '1' for row in rows)} | {statistics.mean(float(row[3]) for row in rows):.0f} |")
END
