#!/usr/bin/env bash
# one-line.sh CODE TEXT COMMAND...: whether a command ends with the exit code, and one line that contains the text.
out=$("${@:3}" 2>&1)
code=$?
[[ $code -eq $1 && $out == *"$2"* && $(wc -l <<<"$out") -eq 1 ]] || { echo "exit code $code: $out" && exit 1; }
