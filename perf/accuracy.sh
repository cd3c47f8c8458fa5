#!/usr/bin/env bash
# The README's accuracy table: PSNR (sRGB-encoded, dB) of every method against the truth, and the
# time of CoC and method, for the built-in plate 1 and, where the folder exists, the ray-traced
# scenes of SCENES (scene/pinhole.exr, truth_SETTING.exr, camera.json).
# accuracy.sh DEFRAY [SCENES]
set -euo pipefail
defray=$1
scenes=${2:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Pictures to be rendered: name, pinhole, truth, camera options.
subjects=()
"$defray" scene plate1 -o "$folder" --truth-samples 1024 >/dev/null
subjects+=("plate1|$folder/pinhole.exr|$folder/truth.exr|--camera $folder/camera.json")
if [ -d "$scenes" ]; then
  for pair in fence:bg fence:mid spheres:f3 spheres:f8; do
    scene=$scenes/${pair%:*} setting=${pair#*:}
    subjects+=("${pair/:/ }|$scene/pinhole.exr|$scene/truth_$setting.exr|--camera \
$scene/camera.json --focus-setting $setting")
  done
fi

field() { sed "s/.*\"$1\":\([^,}]*\).*/\1/"; }

psnr() { # picture truth
  printf ' %.2f' "$("$defray" compare "$1" "$2" --json | field psnr_srgb_db)"
}

row() { # name options...
  local name=$1 subject pinhole truth camera seconds
  shift
  printf '| %s |' "$name"
  for subject in "${subjects[@]}"; do
    IFS='|' read -r _ pinhole truth camera <<<"$subject"
    # shellcheck disable=SC2086  # the camera is several words
    seconds=$("$defray" render "$pinhole" -o "$folder/out.exr" --json $camera "$@" | field render_s)
    psnr "$folder/out.exr" "$truth"
    printf ' (%.2f s) |' "$seconds"
  done
  echo
}

printf '| method |'
for subject in "${subjects[@]}"; do printf ' %s |' "${subject%%|*}"; done
printf '\n|---|%s\n' "$(printf -- '---|%.0s' "${subjects[@]}")"
printf '| pinhole |'
for subject in "${subjects[@]}"; do
  IFS='|' read -r _ pinhole truth _ <<<"$subject"
  psnr "$pinhole" "$truth"
  printf ' |'
done
echo
row 'rdb --quality draft' --quality draft
row 'rdb (default)'
row 'rdb --quality high' --quality high
row 'rdb --literal, 9×9' --literal
row 'rdb --literal, 33×33' --literal --rdb 33
row 'linear' --method linear
row 'gather literal, 32 samples × 2' --method gather --gather literal
row 'gather aware, 32 samples × 2' --method gather
row 'gather aware, 128 samples × 2' --method gather --samples 128
