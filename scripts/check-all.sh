#!/usr/bin/env bash
# Runs every check, before an issue is resolved. Prints each part's name, outcome and time, and a table at the end.
#   scripts/check-all.sh [PART...]     some parts: format tidy release sanitize tsan packages
#                                      debian13 packages13
# Exit status 1 if any failed. Takes hours from scratch. The last three need root.
source "$(dirname "$0")/lib.sh"
export HYBRID_SLAM_WERROR=ON
parts=(format tidy release sanitize tsan packages debian13 packages13)
for part in "$@"; do
  [[ " ${parts[*]} " == *" $part "* ]] || { echo "error: unknown part $part, expected ${parts[*]}" >&2; exit 2; }
done

run() {
  case $1 in
    release) scripts/test.sh && scripts/demo.sh build/demo ;;
    packages) scripts/package.sh && scripts/test-packages.sh ;;
    debian13) scripts/debian13.sh && scripts/debian13.sh scripts/demo.sh build/demo ;;
    packages13)
      scripts/debian13.sh scripts/package.sh && scripts/test-packages.sh trixie build/debian13/build/packages ;;
    *) scripts/check.sh "$1" ;;
  esac
}

table=() failed=0
for part in "${@:-${parts[@]}}"; do
  echo "== $part"
  start=$SECONDS outcome=passed
  run "$part" || outcome=FAILED failed=1
  took=$((SECONDS - start))
  table+=("$(printf '%-10s %-7s %3d min %02d s' "$part" "$outcome" $((took / 60)) $((took % 60)))")
  echo "== ${table[-1]}"
done
echo
printf '%s\n' "${table[@]}"
exit $failed
