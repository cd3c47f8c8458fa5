#!/usr/bin/env bash
# Runs the kernel tests under Oclgrind: memory outside buffers and data races in every kernel.
# oclgrind.sh PROGRAM [FILTER]. Oclgrind exits with 0 whatever it finds, so its log is what counts.
set -euo pipefail
unset DEFRAY_TEST_LONG
program=$1
filter=${2:-*}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
ran=$(oclgrind --data-races --log "$log" "$program" --gtest_filter="$filter" | tee /dev/stderr)
if ! grep -q 'PASSED  \] [1-9]' <<<"$ran"; then
  echo "No test ran: $filter"
  exit 1
fi
if [ -s "$log" ]; then
  echo "Oclgrind found:"
  head -40 "$log"
  exit 1
fi
echo "Oclgrind found nothing."
