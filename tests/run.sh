#!/usr/bin/env bash
# All tests: installs what is missing, builds, runs CTest. Arguments go to ctest (-R Render, -V …).
export EXTRA_PACKAGES="libgtest-dev librapidcheck-dev libbenchmark-dev clang-format clang-tidy
  libclang-rt-14-dev oclgrind mesa-opencl-icd xvfb xdotool chromium"
source "$(dirname "${BASH_SOURCE[0]}")/../cli/setup.sh"
build "$project/build" -DCMAKE_BUILD_TYPE=Release -DDEFRAY_TESTS=ON -DDEFRAY_BENCHMARKS=ON
build "$project/build/asan" -C "$project/tests/presets/asan.cmake"
build "$project/build/fuzz" -C "$project/tests/presets/fuzz.cmake"
exec ctest --test-dir "$project/build" --output-on-failure --parallel "$(nproc)" "$@"
