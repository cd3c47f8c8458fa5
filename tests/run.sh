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
  parallel=$(nproc)
else
  echo "Every kernel, nearly every option, message and documented command (--full: all there is)."
  which=(-L 'quick|both')
  parallel=$(($(nproc) + 1))  # a test waits now and then, for files, processes and threads of its own
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
# Once a minute: what the machine has left, and what has run for ten minutes: a test that hangs, and
# what it waits for.
watch_machine() {
  while sleep 60; do
    printf '[%d s] load %s, MiB free: %s of memory, %s of disk\n' $((SECONDS - begin)) \
      "$(cut -d' ' -f1 /proc/loadavg)" "$(awk '/MemAvailable/ { print int($2 / 1024) }' /proc/meminfo)" \
      "$(df -m --output=avail "$folder" | tail -n 1 | tr -d ' ')" >>"$folder/machine.log"
    ps -eo pid=,ppid=,stat=,wchan:24=,etimes=,args= |
      awk -v whole=$((SECONDS - begin - 60)) '$2 != 2 && $5 > 600 && $5 < whole' | cut -c1-200 >"$folder/long-ones.now"
    [ ! -s "$folder/long-ones.now" ] || mv "$folder/long-ones.now" "$folder/long-ones"
  done
}
# What failed tests said, from their own first lines; of a program that says nothing of tests, the end.
show_failures() {
  awk '/^[0-9]+\/[0-9]+ Testing: / { name = $3 }
       /^Output:$/ { count = 0; said = ""; next }
       /^<end of output>/ { end = count }
       { lines[count++] = substr($0, 1, 200) }
       /^\[ RUN / { first = count - 1 }
       /^\[  FAILED  \].* ms\)$/ { for (i = first; i < count && i < first + 40; ++i) said = said lines[i] "\n" }
       /^Test Failed\./ {
         print "-- " name
         if (said == "") for (i = end > 30 ? end - 30 : 1; i < end; ++i) said = said lines[i] "\n"
         printf "%s", substr(said, 1, 12000)
       }' "$folder/Testing/Temporary/LastTest.log"
}
step "Testing"
rm -f "$folder"/long-ones* "$folder/machine.log"
watch_machine >/dev/null 2>&1 &
watching=$!
trap 'kill $watching 2>/dev/null || true' EXIT
code=0
ctest --test-dir "$folder" --progress --output-on-failure --parallel "$parallel" \
  --repeat after-timeout:2 "${which[@]}" "${rest[@]}" || code=$?
failures=$(show_failures)
if [ -n "$failures" ]; then
  printf 'What failed, or hung and was run once more:\n%s\n' "$failures"
  if [ -s "$folder/long-ones" ]; then echo "Ran for ten minutes:" && cat "$folder/long-ones"; fi
  if [ -s "$folder/machine.log" ]; then echo "The machine:" && cat "$folder/machine.log"; fi
fi
count() { cat "$folder"/results/*.json 2>/dev/null | grep -c "$1" || true; }
echo "Of $(count '"status": "RUN"') tests $(count '"failures": \[') failed and" \
  "$(count '"result": "SKIPPED"') were skipped${full:+ for what is not installed here}."
step "$([ $code -eq 0 ] && echo "All passed." || echo "FAILED: see above.")"
exit $code
