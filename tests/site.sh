#!/bin/sh
# The site (mkdocs) and the API reference (Doxygen) build without warnings. $1: the project's folder.
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
