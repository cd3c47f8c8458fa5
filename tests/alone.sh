#!/usr/bin/env bash
# Checks that each file of the library and the command line builds alone, as users build them; the test
# build compiles twelve at a time, and one then finds what another includes. alone.sh BUILD PROJECT
set -euo pipefail
build=$1/alone project=$2
cmake -S "$project" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang \
  -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-Werror > "$build.log"
# What files are compiled with: precompiled headers, and those that are made.
ninja -C "$build" kernels/all {host,cli}/CMakeFiles/defray_{host,cli}.dir/cmake_pch.hxx.pch >> "$build.log"
