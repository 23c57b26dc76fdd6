#!/bin/sh
# Expects that PROGRAM reports a full standard output, and that it works with closed standard descriptors.
#   standard-streams.sh PROGRAM
fail() {
  echo "error: $program $1"
  exit 1
}
program=$1

error=$("$program" --help 2>&1 >/dev/full)
[ $? -eq 1 ] || fail "--help >/dev/full: expected exit status 1"
case $error in
  *": error: cannot write: standard output; "*) ;;
  *) fail "--help >/dev/full: $error" ;;
esac
"$program" --help <&- >&- 2>&- || fail "--help with closed descriptors: exit status $?"
"$program" --no-such-option <&- >&- 2>&-
[ $? -eq 2 ] || fail "--no-such-option with closed descriptors: expected exit status 2"
error=$("$program" --no-such-option 2>&1 >&- <&-)
[ "$(printf '%s\n' "$error" | wc -l)" -eq 1 ] || fail "--no-such-option: $error"
