# The worlds of the experiments; sourced by the scripts that use them (after lib.sh, with `bin` set). Simulates logs
# and converts public ones from HYBRID_SLAM_DATASETS (doc/datasets.md); WORLD-scans is a public log without its odometry,
# WORLD-open the part of a simulated drive before it returns.

simulated_worlds=(csie sheared-1 sheared-3 sheared-6 wing)  # the script may choose others
simulation_options=()  # of simul-floorplan, for all simulated worlds
public_worlds=()
[[ -z ${HYBRID_SLAM_DATASETS:-} ]] || public_worlds=(intel csail killian fr079 dpslam)

# Best settings of `general`: standard proposal, from scripts/search-settings.sh with seeds from 101 on; improved
# proposal, without learning the systematic odometry error (doc/experiments.md).
general_best=grid_weight.exponent=120,grid_weight.sigma=0.2,grid_weight.beams=90
general_best_improved=motion_model.distance_mean_std=0,motion_model.drift_mean_std=0,motion_model.turn_mean_std=0

# Slips of the odometry in the loop csie-30 (80, 170, mixed, jumps): time (s), turn (deg), shift (m).
slips() {
  case $1 in
    csie-mixed) echo "50 30 0.1, 110 -80 0, 160 170 0, 210 80 0.2, 250 -30 0" ;;
    csie-jumps) echo "60 90 3, 110 0 1, 150 180 5, 200 45 1.5, 230 -90 8" ;;
    csie-*) echo "60 ${1#*-} 0, 150 -${1#*-} 0, 230 ${1#*-} 0" ;;
  esac
}

# without_odometry LOG.clf.gz: the log (gzipped CARMEN) with all poses zero.
without_odometry() {
  zcat "$1" | awk '$1 == "FLASER" { for (i = $2 + 3; i <= $2 + 8; ++i) $i = 0; print }' | gzip -n
}

# before_return ROUTE: the first 60 % of the way points.
before_return() {
  awk -v last="$(grep -c '^via' "$1")" \
    '$1 != "via" && $1 != "go" { print; next } ++n < 0.6 * last { print; next } !done++ { print "go", $2, $3 }' "$1"
}

# make_worlds FOLDER: plans, routes and logs of all worlds; keeps existing ones.
make_worlds() {
  local folder=$1 csie=$PWD/datasets/csie world building file
  mkdir -p "$folder"
  for world in "${simulated_worlds[@]}"; do
    [[ ! -f $folder/$world.rawlog ]] || continue
    building=${world%-open}
    case $building in
      csie | csie-*) cp "$csie/csie.plan" "$folder/$world.plan"; cp "$csie/csie-loop.route" "$folder/$world.route" ;;
      wing) cp $csie/wing.plan "$folder/$world.plan"; cp $csie/wing.route "$folder/$world.route" ;;
      rectangle* | octagon | round | clutter | corridor)
        scripts/make-worlds.py "$building" "$folder"
        [[ $world == "$building" ]] ||
          for file in plan route; do cp "$folder/$building.$file" "$folder/$world.$file"; done
        ;;
      *)
        scripts/shear-world.py "${building#*-}" <$csie/csie.plan >"$folder/$world.plan"
        scripts/shear-world.py "${building#*-}" <$csie/csie-loop.route >"$folder/$world.route"
        ;;
    esac
    if [[ $world == *-open ]]; then
      before_return "$folder/$world.route" >"$folder/$world.part"
      mv "$folder/$world.part" "$folder/$world.route"
    fi
    sed -e "s|^plan *=.*|plan = $world.plan|" -e "s|^route *=.*|route = $world.route|" \
      config-ini/simul-csie-loop.ini >"$folder/$world-simul.ini"
    "$bin/simul-floorplan" -q "$folder/$world-simul.ini" --set "odometry.slips=$(slips "$building")" \
      "${simulation_options[@]}" -o "$folder/$world.rawlog"
  done
  for world in "${public_worlds[@]}"; do
    [[ ! -f $folder/$world.rawlog ]] || continue
    file=$HYBRID_SLAM_DATASETS/$(log_of "$world").clf.gz
    if [[ $world == *-scans ]]; then
      without_odometry "$file" >"$folder/$world.clf.gz"
      file=$folder/$world.clf.gz
    fi
    "$bin/log2rawlog" "$file" "$folder/$world.rawlog" >/dev/null 2>"$folder/$world.log"
  done
}

log_of() {
  case $1 in
    intel*) echo intel-lab ;;
    csail*) echo csail ;;
    killian) echo mit-killian ;;
    dpslam) echo dpslam-loop5 ;;
    *) echo "$1" ;;
  esac
}

# compare WORLD FOLDER OPTION...: slam-compare on a world of FOLDER with its ground truth, with the settings of $ini
# (default: csie-lms100.ini for simulated worlds, paper.ini for logs). A run on a public log succeeds if the mean
# translation error is below 0.1 m (Killian Court, 1.9 km with timestamps accurate to 0.02 m: 0.3 m); on DP-SLAM's loop,
# which has no reference, by the revisit error.
compare() {
  local world=$1 folder=$2 log truth
  shift 2
  log=${HYBRID_SLAM_DATASETS:-}/$(log_of "$world")
  truth=("${ini:-config-ini/paper.ini}" "$folder/$world.rawlog" --relations "$log.relations")
  case $world in
    csail*) ;;
    intel* | fr079) truth+=(--odometry "$log.odom.gz") ;;
    killian) truth+=(--odometry "$log.odom.gz" --success-relations 0.3) ;;
    dpslam) truth=("${ini:-config-ini/paper.ini}" "$folder/$world.rawlog" --revisits 8) ;;
    *)
      truth=("${ini:-config-ini/csie-lms100.ini}" "$folder/$world.rawlog" --reference "$folder/$world.tum"
        --floorplan "$folder/$world.plan")
      ;;
  esac
  # slam-compare exits with 1 if a run failed; the report names it, and the other comparisons continue.
  "$bin/slam-compare" "${truth[@]}" "$@" || [[ $? -eq 1 ]]
}
