#!/usr/bin/env bash
# Runs every command of a README's "sh" blocks, in order, in a folder that holds nothing but this
# README at its place. readme_test.sh README DEFRAY [--full]
#
# "```sh project": in the project's folder instead. "```sh slow", "```sh project slow": with --full only.
# "```sh by hand": never, for reasons that the README gives; commands without a block, only indented,
# are refused, as nothing would run them.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readme=$(realpath "$1")
place=$(realpath --relative-to="$project" "$readme")
export PATH=$(realpath "$(dirname "$2")"):$PATH
full=${3:-${DEFRAY_TEST_LONG:+--full}}
folder=$(mktemp -d)
cache=$(mktemp -d)
trap 'rm -rf "$folder" "$cache"' EXIT
# Of the user's cache only kernels that are compiled already.
users=${XDG_CACHE_HOME:-$HOME/.cache}
export POCL_CACHE_DIR=${POCL_CACHE_DIR:-$users/pocl/kcache} MESA_SHADER_CACHE_DIR=$users XDG_CACHE_HOME=$cache
mkdir -p "$folder/$(dirname "$place")"
cp "$readme" "$folder/$place"

# Lines "KIND<TAB>COMMAND"; the kind is what follows "sh", or "plain".
commands=$(awk '/^```sh( |$)/ {on = 1; kind = NF > 1 ? $2 $3 : "plain"; next} /^```/ {on = 0}
                on && !/^#/ && NF {printf "%s\t%s\n", kind, $0}' "$readme")
if grep -nE '^(    |\t)(bash|blender|build/|cmake|ctest|defray|ninja|python3)' "$readme"; then
  echo "$place: a command that is only indented, which no test runs: \`\`\`sh" >&2
  exit 1
fi
count=0
while IFS=$'\t' read -r kind command; do
  [ -z "$command" ] || [ "$kind" = byhand ] && continue
  [[ $kind = *slow ]] && [ "$full" != --full ] && continue
  echo "\$ $command"
  [[ $kind = project* ]] && where=$project || where=$folder
  (cd "$where" && bash -c "$command" </dev/null)
  count=$((count + 1))
done <<<"$commands"
echo "$count commands of $place work."
