#!/usr/bin/env bash
# Builds the Debian packages of this machine's release: libhybrid-slam with the version, libhybrid-slam-dev, hybrid-slam
# and hybrid-slam-gui.
#   scripts/package.sh [-C FOLDER]     FOLDER (build/packages) gets the packages and is emptied before
# DEBFULLNAME and DEBEMAIL name the maintainer. For Debian 13 on Debian 12: scripts/debian13.sh scripts/package.sh
source "$(dirname "$0")/lib.sh"
folder=build/packages
if [[ ${1:-} == -C ]]; then folder=${2:?FOLDER is missing}; shift 2; fi
[[ $# -eq 0 ]] || { echo "error: unknown argument $1, expected -C FOLDER" >&2; exit 2; }
install_packages "${build_packages[@]}" dpkg-dev file help2man

# The date of the release, so that the same sources give the same packages.
SOURCE_DATE_EPOCH=$(date -u -d "$(sed -nE 's/^## \[[0-9.]+\] - //p' CHANGELOG.md | head -n 1)" +%s)
export SOURCE_DATE_EPOCH
# Debian's compiler and linker flags. The packages are stripped, so there are no debug symbols to make.
eval "$(DEB_BUILD_MAINT_OPTIONS=hardening=+all DEB_CXXFLAGS_MAINT_STRIP=-g dpkg-buildflags --export=sh)"
CXXFLAGS+=" $CPPFLAGS"  # CMake does not read CPPFLAGS
build package

rm -rf build/package/packages
cpack --config build/package/CPackConfig.cmake -B "$PWD/build/package/packages"
# CPack makes scripts that call ldconfig, where Debian has a trigger for it (packaging/triggers).
for package in build/package/packages/libhybrid-slam[0-9]*.deb; do
  dpkg-deb --raw-extract "$package" build/package/packages/library
  rm -f build/package/packages/library/DEBIAN/post{inst,rm}
  dpkg-deb --root-owner-group --build build/package/packages/library "$package" >/dev/null
done
mkdir -p "$folder"
rm -f "$folder"/*.deb
mv build/package/packages/*.deb "$folder"
ls -l "$folder"/*.deb
