#!/usr/bin/env bash
# Runs every command of README.md's "sh" blocks, in order, in a folder with the pictures they name.
# readme_test.sh README DEFRAY. The two set-up commands are left out: one of them runs this test.
set -euo pipefail
readme=$1
export PATH=$(dirname "$2"):$PATH
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# The pictures that the README's examples speak of.
defray scene plate1 -o . --width 96 --height 64 --truth-samples 4 >/dev/null
cp pinhole.exr beauty.exr
mkdir -p out
for frame in 1 2 3; do cp pinhole.exr "shot.000$frame.exr"; done

commands=$(awk '/^```sh/ {on = 1; next} /^```/ {on = 0} on' "$readme" |
  grep -v -e '^bash cli/demo.sh' -e '^bash tests/run.sh' -e '^#')
count=0
while IFS= read -r command; do
  [ -z "$command" ] && continue
  echo "\$ $command"
  bash -c "$command" </dev/null
  count=$((count + 1))
done <<<"$commands"
[ "$count" -gt 0 ] || { echo "README.md has no commands"; exit 1; }
echo "$count commands of the README work."
