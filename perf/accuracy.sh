#!/usr/bin/env bash
# The README's accuracy table: PSNR against the truth, for the built-in scene and, where the folder
# exists, the ray-traced scenes of SCENES (scene/pinhole.exr, truth_SETTING.exr, camera.json).
# accuracy.sh DEFRAY [SCENES]
set -euo pipefail
defray=$1
scenes=${2:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

psnr() { # picture truth -> "encoded linear"
  "$defray" compare "$1" "$2" --json |
    sed 's/.*"psnr_srgb_db":\([^,]*\),"psnr_linear_db":\([^,]*\),.*/\1 \2/' |
    awk '{printf "%.2f / %.2f", $1, $2}'
}

row() { # name pinhole truth camera-options...
  local name=$1 pinhole=$2 truth=$3
  shift 3
  printf '| %s | %s |' "$name" "$(psnr "$pinhole" "$truth")"
  for cells in 9 33; do
    "$defray" render "$pinhole" -o "$folder/out.exr" --quiet --rdb $cells "$@"
    printf ' %s |' "$(psnr "$folder/out.exr" "$truth")"
  done
  echo
}

echo '| scene | pinhole | RDB 9×9 | RDB 33×33 |'
echo '|---|---|---|---|'
"$defray" scene plate1 -o "$folder" --truth-samples 1024 >/dev/null
row 'plate1 (built in)' "$folder/pinhole.exr" "$folder/truth.exr" --camera "$folder/camera.json"
[ -d "$scenes" ] || exit 0
for pair in fence:bg fence:mid spheres:f3 spheres:f8; do
  scene=$scenes/${pair%:*} setting=${pair#*:}
  row "${pair/:/ }" "$scene/pinhole.exr" "$scene/truth_$setting.exr" \
    --camera "$scene/camera.json" --focus-setting "$setting"
done
