#!/usr/bin/env bash
# The demo: builds defray, makes the paper's Plate 1, renders it through the ray distribution
# buffer on OpenCL and shows how far from the truth that is. Pictures go to build/demo.
# With $DEFRAY_BUILD, a folder that defray is built in already, all that is there.
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
folder=${DEFRAY_BUILD:-$project/build}
[ -n "${DEFRAY_BUILD:-}" ] || build "$folder" -DCMAKE_BUILD_TYPE=Release

defray=$folder/bin/defray
out=$folder/demo
mkdir -p "$out"
render=("$defray" render "$out/pinhole.exr" --camera "$out/camera.json")

"$defray" scene plate1 -o "$out" >/dev/null
"${render[@]}" -o "$out/result.exr"
"${render[@]}" -o "$out/result.png" --quiet
"$defray" sheet "$out/pinhole.exr" "$out/result.exr" "$out/truth.exr" -o "$out/sheet.png" \
  --captions "pinhole,result,truth: 256 lens rays a pixel" >/dev/null

echo
echo "Pictures: $out/result.exr"
echo "          $out/result.png"
echo "          $out/sheet.png (pinhole | result | truth)"
echo "Error of the pinhole picture against the truth:"
"$defray" compare "$out/pinhole.exr" "$out/truth.exr" | sed 's/^/  /'
echo "Error of the result against the truth:"
"$defray" compare "$out/result.exr" "$out/truth.exr" | sed 's/^/  /'
