#!/usr/bin/env bash
# Installs what is missing (Debian's packages), and defines `build`. Sourced by demo.sh and the
# scripts in tests/; says nothing when nothing is to be done. Packages beyond the program's own:
# $EXTRA_PACKAGES.
set -euo pipefail

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
packages=(g++ cmake ninja-build clang libclang-common-14-dev pkg-config
          ocl-icd-opencl-dev opencl-clhpp-headers pocl-opencl-icd
          libopenimageio-dev openimageio-tools libimath-dev libopencv-dev qtbase5-dev
          libcli11-dev libfmt-dev nlohmann-json3-dev libnanoflann-dev)

install_missing() {
  local missing=() package
  for package in "${packages[@]}" ${EXTRA_PACKAGES:-}; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# build FOLDER [CMAKE OPTIONS]: configures and builds; the log is shown only if that fails.
build() {
  local folder=$1
  shift
  local log
  log=$(mktemp)
  [ -d "$folder/bin" ] || echo "Building in $folder; the first time takes a few minutes"
  if ! { cmake -S "$project" -B "$folder" -G Ninja "$@" && cmake --build "$folder"; } >"$log" 2>&1
  then
    cat "$log" >&2
    rm -f "$log"
    echo "The build in $folder failed; its log is above." >&2
    return 1
  fi
  rm -f "$log"
}

install_missing
