#!/bin/sh
# The site (mkdocs) and the API reference (Doxygen) build without warnings, and the reference describes every class,
# enumeration and free function. $1: the project's folder.
cd "$1" || exit 2
for program in mkdocs doxygen; do
  command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdocs build --strict --quiet --site-dir "$folder/site" || exit 1
# Every page is in the navigation: mkdocs only mentions those that are not.
for page in doc/*.md; do
  grep -q ": $(basename "$page")\$" mkdocs.yml || { echo "$page is not in the navigation of mkdocs.yml"; exit 1; }
done
(cat Doxyfile && echo "OUTPUT_DIRECTORY = $folder") | doxygen - || exit 1
[ -f "$folder/html/index.html" ] || { echo "Doxygen wrote no reference"; exit 1; }
# Members whose names say all need no description.
(cat Doxyfile &&
  printf '%s\n' "OUTPUT_DIRECTORY = $folder" WARN_IF_UNDOCUMENTED=YES WARN_AS_ERROR=NO GENERATE_HTML=NO) |
  doxygen - >"$folder/log" 2>&1
grep -q 'Member .* is not documented' "$folder/log" || { echo "Doxygen names no member"; exit 1; }
! grep -E 'Compound .* is not documented|\((function|enumeration)\) of namespace .* is not documented' "$folder/log"
