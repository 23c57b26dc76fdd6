#!/usr/bin/env bash
# Makes a man page of a program's --help, in the same words.
#   cmake/man-page.sh PROGRAM PAGES OUT.1.gz      PAGES: the installed folder of doc/, for the pages that --help names
set -euo pipefail
program=$1 pages=$2 out=$3
name=$(basename "$program")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# help2man runs this instead of the program. It puts a blank between an option's names, names the installed pages, and
# shows the options of subcommands.
cat >"$folder/$name" <<'END'
#!/usr/bin/env bash
sections=""
if [[ $1 == --help ]] && "$PROGRAM" --help | grep -q '^Subcommands:'; then
  set -- --help-all
  sections='/^Subcommands:|^  Options:/d; s|^([a-z-]+)$|Subcommand \1:|;'
fi
"$PROGRAM" "$1" | sed -E "$sections"'s|^( +-[A-Za-z]),--|\1, --|; s|(^\|[^A-Za-z0-9_./-])(doc/[a-z0-9-]+\.md)|\1'"$PAGES"'/\2|g'
END
chmod +x "$folder/$name"
purpose=$("$program" --help | head -n 1 | sed -E 's/\. Manual: .*//; s/\.$//')
mkdir -p "$(dirname "$out")"
PROGRAM=$program PAGES=$pages \
  help2man --no-info --name="$purpose" --output="$folder/page" "$folder/$name"
gzip -9n <"$folder/page" >"$out"
