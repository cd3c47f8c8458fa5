#!/usr/bin/env bash
# The demo, with what is built already: its pictures are there, and the result is nearer to the
# truth than the pinhole picture by 6 dB. demo_test.sh BUILD
set -euo pipefail
build=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$build/demo"
DEFRAY_BUILD=$build bash "$here/../cli/demo.sh" | tee "$build/demo.log"
for picture in result.exr result.png sheet.png; do
  [ -s "$build/demo/$picture" ] || { echo "demo: $picture is missing" >&2; exit 1; }
done
# A PSNR after each of the two headings.
grep -oP 'PSNR \K[0-9.]+' "$build/demo.log" |
  awk '{db[NR] = $1} END {exit !(NR == 2 && db[2] > db[1] + 6)}' ||
  { echo "demo: no two PSNRs, the second 6 dB higher" >&2; exit 1; }
