#!/usr/bin/env bash
# `build` of cli/setup.sh, with a cmake that only counts: what it says of a long build, in a file
# and on a terminal, and of one that fails.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
cat >"$work/bin/cmake" <<'CMAKE'
#!/usr/bin/env bash
[ "$1" = --build ] || exit 0
for i in 1 2 3; do echo "[$i/3] Building $i"; done
[ ! -e "$2/fails" ] || { echo "error: no such type"; exit 1; }
CMAKE
chmod +x "$work/bin/cmake"
export PATH=$work/bin:$PATH

# `build` of a folder of this name: what it says, then its exit code.
say() {
  local folder=$work/$1
  "${@:2}" bash -c "source '$here/../cli/setup.sh'; build '$folder' || exit 7" 2>&1
  echo "code $?"
}
expect() {
  [[ $1 == *"$2"* ]] && return
  printf 'build: expected "%s" in\n%s\n' "$2" "$1" >&2
  exit 1
}
refuse() {
  [[ $1 != *"$2"* ]] && return
  printf 'build: "%s" is too much in\n%s\n' "$2" "$1" >&2
  exit 1
}

short=$(say new env)
expect "$short" "several minutes (log: $work/new/build.log)"
expect "$short" "code 0"
refuse "$short" " of 3 steps"
expect "$(cat "$work/new/build.log")" "[3/3] Building 3"
mkdir -p "$work/old/bin"
[ "$(say old env)" = "code 0" ] || expect "$(say old env)" "nothing but its code"

expect "$(say long env BUILD_SAYS_EVERY=0)" "Building: 2 of 3 steps"

mkdir "$work/bad" && touch "$work/bad/fails"
failed=$(say bad env)
expect "$failed" "error: no such type"
expect "$failed" "The build in $work/bad failed; the end of its log, $work/bad/build.log, is above."
expect "$failed" "code 7"

on_terminal() { script -qec "$(printf '%q ' "$@")" /dev/null; }
if command -v script >/dev/null; then
  shown=$(say seen on_terminal)
  expect "$shown" $'\r\e[KBuilding: 3 of 3 steps'
  expect "$shown" "code 0"
fi
echo "build says how far it is."
