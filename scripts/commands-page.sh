#!/usr/bin/env bash
# Prints doc/commands.md: the --help of every program.
#   scripts/commands-page.sh BIN >doc/commands.md      BIN: a folder of programs
set -euo pipefail
PATH=$(cd "$1" && pwd):$PATH
cat <<'END'
# Command lines

The `--help` of every program. The Debian packages have the same text as man pages (`man hybrid-slam`).
END
for program in hybrid-slam hybrid-slam-live observation-server hybrid-slam-gui slam-merge log2rawlog motion-model-learn \
  simul-floorplan slam-compare slam-eval; do
  printf '\n## %s\n\n```\n' "$program"
  COLUMNS=100 "$program" --help
  printf '```\n'
done
