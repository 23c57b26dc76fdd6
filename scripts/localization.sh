#!/usr/bin/env bash
# Localisation in the map of another run, as Markdown tables: tracking from a given start, 100 random starts without
# one, and 20 jumps to another place that the odometry does not see.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/localization.sh [OUT]     OUT defaults to out/localization
# A place is right within 0.5 m and 10 deg, a spread small below 1 m. A scan is in the map if the map explains 70 % of
# its beams at its reference pose and contradicts less than 15 %.
# SEED chooses the starts (2; the constants of libs/slam/localization were chosen with seed 1), STARTS and JUMPS their
# numbers, JOBS how many of them run at a time (1), and CASES selects the rows.
#   csie           simulated; map and scans with different noise; reference: the truth
#   intel-half     map from the first half of the log, scans from the second half; reference: a run of the whole log,
#                  aligned with the run of the first half
#   intel-lab      map and scans from the same log, with different seeds; reference: the mapping run
#   mit-killian    as intel-lab
#   killian-odd    map from every second scan, localised with the others; reference: the mapping run, between its scans
#                  odometry
source "$(dirname "$0")/lib.sh"
out=${1:-out/localization}
data=${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}
read -ra cases <<<"${CASES:-csie intel-half intel-lab mit-killian killian-odd}"
install_packages "${packages[@]}"
build release hybrid-slam slam-eval simul-floorplan hybrid-slam-localization
bin=$PWD/build/release/bin
mkdir -p "$out"
out=$(realpath "$out")

# map LOG NAME [OPTION...]: a mapping run, unless it is there.
map() {
  [[ -d $out/$2 ]] || "$bin/hybrid-slam" "$1" -q -o "$out/$2" "${@:3}" >/dev/null 2>"$out/$2.log"
}
# scans LOG CONDITION NAME: the FLASER lines number n that meet an awk condition, and all others.
scans() {
  [[ -f $out/$3 ]] || zcat "$1" | awk "/^FLASER/ { n++; if (!($2)) next } 1" | gzip -n >"$out/$3"
}

# prepare CASE: makes its maps, and sets `study` to the arguments of the study.
prepare() {
  local intel=$data/intel-lab.clf.gz killian=$data/mit-killian.clf.gz seed
  case $1 in
    csie)
      for seed in 1 2; do
        [[ -f $out/csie-$seed.rawlog ]] ||
          "$bin/simul-floorplan" -q config-ini/simul-csie.ini --set simulation.seed=$seed -o "$out/csie-$seed.rawlog"
      done
      map "$out/csie-1.rawlog" csie
      study=("$out/csie" "$out/csie-2.rawlog" "$out/csie-2.tum" "$out/csie-1.tum") ;;
    intel-half)
      map "$intel" intel-whole
      scans "$intel" "n <= 2326" intel-half.clf.gz
      map "$out/intel-half.clf.gz" intel-half
      study=("$out/intel-half" "$intel" "$out/intel-whole/trajectory.tum" "$out/intel-whole/trajectory.tum" from=0.5) ;;
    killian-odd)
      scans "$killian" "n % 2" killian-odd.clf.gz
      map "$out/killian-odd.clf.gz" killian-odd
      study=("$out/killian-odd" "$killian" "$out/killian-odd/trajectory.tum" "$out/killian-odd/trajectory.tum" held_out=1) ;;
    *)
      map "$data/$1.clf.gz" "$1" -s 7
      study=("$out/$1" "$data/$1.clf.gz" "$out/$1/trajectory.tum" "$out/$1/trajectory.tum") ;;
  esac
}

# relations CASE: mean error of the human-made relations, m, of the tracked poses.
relations() {
  local log=intel-lab
  [[ $1 != csie ]] || { echo; return; }
  [[ $1 != *killian* ]] || log=mit-killian
  "$bin/slam-eval" relations --trajectory "$out/$1.tum" --relations "$data/$log.relations" 2>/dev/null |
    python3 -c 'import json, sys; e = json.load(sys.stdin); print("%.3f (%d)" % (e["trans_mean_m"], e["relations"]))' || echo
}

# table MODE HEADER COUNT: runs a mode of the study for each case.
table() {
  echo "| log $2"
  echo "$2" | sed 's/[^|]//g; s/|/|---/g; s/^/|---/; s/---$//'
  for case in "${cases[@]}"; do
    prepare "$case"
    "$bin/hybrid-slam-localization" "$1" "${study[@]}" seed="${SEED:-2}" count="$3" jobs="${JOBS:-1}" \
      out="$out/$case.tum" >"$out/$1-$case.csv"
    echo "| $case $(tail -n 1 "$out/$1-$case.csv")$([[ $1 != track ]] || echo " $(relations "$case") |")"
  done
  echo
}
table track "| scans | rms m | median m | 99 % m | median deg | within 0.1 m, 1 deg | of those in the map | unknown | lost | x real time | relations m (number) |" 1
table find "| starts | right within 15 m | of those in the map | right | wrong places declared | starts with a wrong small spread | median / 95 % m | median / 95 % s | mean / slowest ms |" \
  "${STARTS:-100}"
table carry "| jumps | right within 15 m | of those in the map | right | wrong places declared | jumps with a wrong small spread | median / 95 % m | median / 95 % s | mean / slowest ms |" \
  "${JUMPS:-20}"
