#!/usr/bin/env bash
# Runs every command of README.md's "sh" blocks, in order, in an empty folder.
# readme_test.sh README DEFRAY. The two set-up commands are left out: one of them runs this test.
set -euo pipefail
readme=$1
export PATH=$(dirname "$2"):$PATH
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

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
