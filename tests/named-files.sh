#!/bin/sh
# Every source file that the documentation names in backquotes exists. $1: the project's folder.
cd "$1" || exit 2
missing=$(grep -oHE '`[A-Za-z0-9_./-]+\.(h|cpp|sh)`' README.md doc/*.md | tr -d '`' | sort -u |
  while IFS=: read -r page name; do
    [ -n "$(find . -path ./build -prune -o -path "*/$name" -print -quit)" ] ||
      echo "$page names $name, which is not there"
  done)
[ -z "$missing" ] || { echo "$missing"; exit 1; }
