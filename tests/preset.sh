#!/usr/bin/env bash
# Builds an instrumented variant in build/NAME and runs the whole suite in it.
# preset.sh tsan|coverage [gtest arguments]. Coverage ends with its figures and a page.
export EXTRA_PACKAGES="libgtest-dev librapidcheck-dev libclang-rt-14-dev gcovr"
name=${1:-}
shift || true
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [ ! -f "$tests/presets/$name.cmake" ]; then
  echo "usage: preset.sh tsan|coverage [gtest arguments]" >&2
  exit 2
fi
source "$tests/../cli/setup.sh"
folder=$project/build/$name
build "$folder" -C "$tests/presets/$name.cmake"

if [ "$name" = coverage ]; then find "$folder" -name '*.gcda' -delete; fi
failed=0
for program in kernels_tests host_tests command_tests; do
  bash "$tests/preset_run.sh" "$name" "$folder/bin/$program" "$@" || failed=1
done
if [ "$name" = coverage ]; then
  mkdir -p "$folder/report"
  gcovr --root "$project" --filter "$project/host/" --filter "$project/cli/" \
    --exclude-throw-branches --html-details "$folder/report/index.html" --print-summary \
    "$folder" >"$folder/report/files.txt"
  tail -n 3 "$folder/report/files.txt"
  echo "Page: $folder/report/index.html"
fi
exit "$failed"
