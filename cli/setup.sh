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

# Keeps what it reads in LOG, and shows ninja's count in it: on a terminal in one line that is
# rewritten, else in a line a minute.
show_count() {
  local log=$1 line count said=$SECONDS
  while IFS= read -r line; do
    printf '%s\n' "$line"
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    count="${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} steps"
    if [ -t 3 ]; then
      printf '\r\033[KBuilding: %s' "$count" >&3
    elif [ $((SECONDS - said)) -ge "${BUILD_SAYS_EVERY:-60}" ]; then
      printf 'Building: %s\n' "$count" >&3
      said=$SECONDS
    fi
  done 3>&1 >"$log"
  [ ! -t 1 ] || printf '\r\033[K'
}

# build FOLDER [CMAKE OPTIONS]: configures and builds; the log, FOLDER/build.log, is shown only if
# that fails.
build() {
  local folder=$1 log=$1/build.log
  shift
  mkdir -p "$folder"
  [ -d "$folder/bin" ] ||
    echo "Building in $folder; the first time takes several minutes (log: $log)"
  if ! { cmake -S "$project" -B "$folder" -G Ninja "$@" && cmake --build "$folder"; } 2>&1 |
    show_count "$log"
  then
    tail -n 200 "$log" >&2
    echo "The build in $folder failed; the end of its log, $log, is above." >&2
    return 1
  fi
}

install_missing
