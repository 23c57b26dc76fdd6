#!/usr/bin/env bash
# Prints the versions of the libraries below the programs in Debian 12 and 13: the table of doc/security.md. Reads the
# package lists of both releases from this machine's mirror.
source "$(dirname "$0")/lib.sh"
lists=$(mktemp -d)
trap 'rm -rf "$lists"' EXIT

# apt_of RELEASE COMMAND...: apt with the lists of this release alone.
apt_of() {
  local place=$lists/$1 tool=$2
  mkdir -p "$place"/{lists/partial,cache/archives/partial}
  debian_sources "$1" >"$place/sources.list"
  shift 2
  "$tool" -o Dir::Etc::sourcelist="$place/sources.list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$place/lists" \
    -o Dir::State::status=/dev/null -o Dir::Cache="$place/cache" "$@"
}
# version RELEASE PACKAGE: upstream's part of Debian's version number.
version() {
  apt_of "$1" apt-cache show "$2" | sed -En '/^Version: /{s/^Version: ([0-9]+:)?(.*really)?([0-9.]*[0-9]).*/\3/p;q}'
}

for release in bookworm trixie; do apt_of "$release" apt-get update -q >&2; done
echo "| library | for | Debian 12 | Debian 13 |"
echo "|---|---|---|---|"
while IFS='|' read -r package name use; do
  echo "| $name | $use | $(version bookworm "$package") | $(version trixie "$package") |"
done <<'END'
libmrpt-dev|MRPT|logs, poses, filter, sensors, window
libopencv-dev|OpenCV|reading and writing PNG files
zlib1g-dev|zlib|gzip
libbz2-dev|bzip2|bzip2
libzstd-dev|zstd|compressed bags
liblz4-dev|LZ4|compressed bags
libsqlite3-dev|SQLite|`.db3` bags
libtbb-dev|oneTBB|threads
libeigen3-dev|Eigen|linear algebra
libnanoflann-dev|nanoflann|nearest neighbours
libcli11-dev|CLI11|command lines
nlohmann-json3-dev|nlohmann-json|JSON
libyaml-cpp-dev|yaml-cpp|`map.yaml`
libdxflib-dev|dxflib|DXF drawings
libwxgtk3.2-dev|wxWidgets|window
END
