#!/usr/bin/env bash
# Puts random faults into kernels and host code, one at a time, beside the work tree, and says which
# of them the tests let pass: mutate.sh [--count N] [--seed S] [--in FOLDER]; more: --help.
export EXTRA_PACKAGES="libgtest-dev librapidcheck-dev libbenchmark-dev lld llvm oclgrind python3"
source "$(dirname "${BASH_SOURCE[0]}")/../cli/setup.sh"
folder=$project/build/tests
case " $* " in *" --help "* | *" -h "*) exec python3 "$project/tests/mutation/mutate.py" "$@" ;; esac
build "$folder" -C "$project/tests/presets/tests.cmake"
# What each test reaches, from a run of them all after the last build.
if [ ! -f "$folder/reached/done" ] || [ "$folder/bin/command_tests" -nt "$folder/reached/done" ]; then
  echo "Running all tests once, to see what each of them reaches"
  rm -rf "$folder"/reached/*/*
  export POCL_CACHE_DIR=$folder/kernel-cache
  mkdir -p "$POCL_CACHE_DIR"
  ctest --test-dir "$folder" --parallel "$(nproc)" -L 'quick|both' -R '^(command|kernels|host|properties)' \
    --output-on-failure >"$folder/reached.log" 2>&1 || { cat "$folder/reached.log"; exit 1; }
  touch "$folder/reached/done"
fi
exec python3 "$project/tests/mutation/mutate.py" "$@"
