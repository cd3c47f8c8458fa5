#!/usr/bin/env bash
# Checks that each file of the library and the command line compiles alone, as `cli/demo.sh` builds it:
# the test build takes twelve together, where one finds what another includes. alone.sh BUILD PROJECT
set -euo pipefail
build=$1/alone project=$2
{
  cmake -S "$project" -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS=-Werror
  ninja -C "$build" {host/CMakeFiles/defray_host,cli/CMakeFiles/defray_cli}.dir/cmake_pch.hxx.pch
} > "$build.log"
cd "$build"
# Those that the test build leaves alone, too, need no second look.
sed -n 's/^ *"command": "\(.*\)",\?$/\1/p' compile_commands.json | sed 's/\\\(.\)/\1/g' |
  grep -E -- " -c $project/(host|cli)/.*\.cpp$" | grep -vE "/host/(library|scenes/builtin)/" > commands
[ "$(wc -l < commands)" -gt 200 ] || { echo "alone: too few files in $build/commands" >&2; exit 1; }
xargs -d '\n' -P "$(nproc)" -I COMMAND bash -c 'COMMAND -fsyntax-only' < commands
