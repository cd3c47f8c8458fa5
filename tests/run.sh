#!/usr/bin/env bash
# All tests: run.sh [--full] [-R NAME] [arguments for ctest]. What that means: tests/README.md.
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
full= name= rest=()
while [ $# -gt 0 ]; do
  case $1 in
    --full) full=1 ;;
    -R) name=$2 && shift ;;
    *) rest+=("$1") ;;
  esac
  shift
done
begin=$SECONDS
export EXTRA_PACKAGES="libgtest-dev librapidcheck-dev libbenchmark-dev clang-format lld"
if [ -n "$full" ]; then
  EXTRA_PACKAGES+=" libclang-rt-14-dev oclgrind mesa-opencl-icd xvfb xdotool chromium blender llvm python3"
fi
source "$project/cli/setup.sh"

folder=$project/build/tests
if [ -n "$full" ]; then
  echo "All tests, sanitizers, simulator, second OpenCL implementation, faults and fuzzers included."
  export DEFRAY_TEST_LONG=1
  which=(-L 'full|both')
else
  echo "Every kernel, nearly every option, message and documented command (--full: all there is)."
  which=(-L 'quick|both')
fi
step() { echo "[$((SECONDS - begin)) s] $1"; }
step "Building"
build "$folder" -C "$project/tests/presets/tests.cmake" -DDEFRAY_SANITIZED_TESTS=${full:+ON} \
  -DDEFRAY_BENCHMARKS=${full:+ON}

# Kernels are compiled anew for each build, and the user's cache is left alone.
export POCL_CACHE_DIR=$folder/kernel-cache XDG_CACHE_HOME=$folder/cache
rm -rf "$folder/results" "$POCL_CACHE_DIR" "$XDG_CACHE_HOME" "$folder"/reached/*/*
mkdir -p "$POCL_CACHE_DIR" "$XDG_CACHE_HOME"
if [ -n "$name" ]; then
  export GTEST_FILTER="*$name*"
  which+=(-L gtest)
fi
step "Testing"
code=0
# One more than cores: a test waits now and then, for files, processes and threads of its own.
ctest --test-dir "$folder" --progress --output-on-failure --parallel $(($(nproc) + 1)) "${which[@]}" \
  "${rest[@]}" || code=$?
count() { cat "$folder"/results/*.json 2>/dev/null | grep -c "$1" || true; }
echo "Of $(count '"status": "RUN"') tests $(count '"failures": \[') failed and" \
  "$(count '"result": "SKIPPED"') were skipped${full:+ for what is not installed here}."
step "$([ $code -eq 0 ] && echo "All passed." || echo "FAILED: see above.")"
exit $code
