# Shared by the scripts: packages and build. Sourced, not run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build_packages=(
  g++ cmake ninja-build ccache
  libmrpt-dev mrpt-common libopencv-dev libeigen3-dev libtbb-dev libcli11-dev nlohmann-json3-dev libnanoflann-dev
  libyaml-cpp-dev libdxflib-dev zlib1g-dev libbz2-dev libzstd-dev liblz4-dev libsqlite3-dev
  libwxgtk3.2-dev libx11-dev
)
packages=(  # for the tests too
  "${build_packages[@]}"
  libgl1-mesa-dri libegl1 xvfb xauth openbox libgtest-dev libgmock-dev libbenchmark-dev
  python3 librosbag-storage-dev libsensor-msgs-dev libnav-msgs-dev libtf2-msgs-dev
  mrpt-apps mkdocs doxygen gnuplot-nox locales
)

# Installs missing Debian packages, as root or with sudo.
install_packages() {
  local missing=() package
  for package in "$@"; do
    [[ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" == installed ]] || missing+=("$package")
  done
  [[ ${#missing[@]} -eq 0 ]] && return
  local as_root=()
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || { echo "error: root or sudo is needed to install: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}

# build PRESET [TARGET...]
build() {
  local preset=$1
  shift
  cmake --preset "$preset"
  cmake --build --preset "$preset" ${1:+--target "$@"}
}

# debian_sources RELEASE: lines of sources.list with this machine's mirror, for another release of Debian.
debian_sources() {
  local here uri suite component
  here=$(. /etc/os-release && echo "$VERSION_CODENAME")
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    while read -r uri suite component; do
      [[ "$suite $component" != "$here main" ]] || echo "deb $uri $1 main"
    done
}
