#!/usr/bin/env bash
# The library as a user has it: installed, found by CMake and by pkg-config, used without any other
# header of ours, with the bits of the command line. library_test.sh BUILD PROJECT CXX
set -euo pipefail
build=$(realpath "$1") project=$(realpath "$2") cxx=$3
here=$project/tests/library
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt") abi=${version%.*}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# Pixels: headers carry the time.
same() {
  local hash
  hash=$(iinfo --hash "$1" | grep -oE '[0-9A-F]{40}') || complain "$1 has no hash"
  iinfo --hash "$2" | grep -q "$hash" || complain "$1 and $2 differ"
}
complain() { echo "library: $*" >&2; exit 1; }

# The commands of the library's README, in a home of their own, with the program of the main one.
block() { awk -v kind="$1" '/^```/ {on = $0 == "```" kind; next} on' "$2"; }
mkdir app home
ln -s "$build" build
block cpp "$project/README.md" >app/app.cpp
block cmake "$project/host/include/README.md" >app/CMakeLists.txt
block sh "$project/host/include/README.md" >commands.sh
HOME=$folder/home bash -euo pipefail commands.sh >commands.log ||
  { cat commands.log; complain "a command of host/include/README.md fails"; }

prefix=$folder/home/.local
library=$(find "$prefix" -name libdefray.so)
export PATH=$prefix/bin:$PATH PKG_CONFIG_PATH=$(dirname "$library")/pkgconfig
soname=$(readelf -d "$library" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')
[ "$soname" = "libdefray.so.$abi" ] || complain "its name is '$soname'"
[ -e "$(dirname "$library")/$soname" ] || complain "$soname is missing"
readelf -d "$library" | grep -q NODELETE || complain "it can be unloaded under its own threads"

# Only the API shows.
nm -DC --defined-only "$library" | cut -d' ' -f2- >symbols
grep -vE "^. (DEFRAY_${abi/./\\.}\$|(typeinfo( name)?|vtable) for defray::Error@|defray::)" symbols \
  >foreign || true
[ -s foreign ] && complain "it shows what is not the API: $(head -3 foreign)"
grep -q 'T defray::render(defray::Device' symbols || complain "render does not show"
# All of it in each build: what these objects neither hold nor need comes in by chance alone, beside
# what a unity build has compiled with it. (Methods' and qualities' names are in files that they need.)
nm -C "$build"/host/CMakeFiles/defray_host.dir/library/*.o | cut -c18- >own
sed -n 's/@.*//; s/^T defray::/defray::/p' symbols | grep -vE '^defray::(test::|all_methods|settings_for|to_string)' | while IFS= read -r symbol; do
  grep -qF "$symbol" own || echo "$symbol"
done >elsewhere
[ -s elsewhere ] && complain "it shows this by chance: $(head -3 elsewhere)"
grep -E 'defray::(Session|DeviceBackend|Frame|ImageFile|run_chain|apply_method)\b' symbols &&
  complain "it shows its inner works"

# Every header compiles alone, strictly, as the program does, and none brings another library's.
strict=("$cxx" -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -fsyntax-only
        -I "$prefix/include")
for header in "$prefix"/include/defray/*.h; do
  "${strict[@]}" -include "$header" -x c++ /dev/null
done
"${strict[@]}" app/app.cpp
"$cxx" -std=c++20 -M -I "$prefix/include" -include "$prefix/include/defray/defray.h" -x c++ \
  /dev/null | tr ' ' '\n' >included
grep -iE '/(CL|fmt|nlohmann|OpenImageIO|opencv[^/]*|Imath|kernels)/' included &&
  complain "its headers bring others"

mkdir user && cp "$here"/{api.cpp,expectations.h,CMakeLists.txt} user
cmake -S user -B user/build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" >cmake.log
cmake --build user/build >build.log || { cat build.log; complain "find_package"; }
[ "$(pkg-config --modversion defray)" = "$version" ] || complain "pkg-config has another version"

defray scene fence -o scene --width 96 --height 64 --truth-samples 1 >scene.log
defray render scene/pinhole.exr -o cli.exr --focus 1.2 --aperture-diameter 35 --focal-length 50 -q
app/build/app scene/pinhole.exr cmake.exr
app/app scene/pinhole.exr pkg_config.exr
same cmake.exr cli.exr
same pkg_config.exr cli.exr
# With alpha, grey, or a part of a larger frame.
defray scene cutout -o cutout --alpha --width 96 --height 64 --truth-samples 1 >scene.log
oiiotool scene/pinhole.exr --ch Y=G,Z -o grey.exr
oiiotool cutout/pinhole.exr --ch Y=G,A,Z -o grey_alpha.exr
oiiotool scene/pinhole.exr --fullsize 128x90-10-20 -o window.exr
for picture in cutout/pinhole grey grey_alpha window; do
  defray render $picture.exr -o cli.exr --focus 1.2 --aperture-diameter 35 --focal-length 50 -q
  app/app $picture.exr app.exr
  same app.exr cli.exr
done
if app/app missing.exr x.exr 2>error; then complain "a missing file is no error"; fi
grep -q 'missing.exr' error || complain "a missing file is not named: $(cat error)"

mkdir out
user/build/api scene/pinhole.exr out "$version"
defray render scene/pinhole.exr -o out/cli.exr --focus 5 --aperture-diameter 35 --focal-length 50 --sensor-width 5 -q \
  --coc-out out/cli_coc.exr --confidence-out out/cli_confidence.exr
same out/api.exr out/cli.exr
same out/file.exr out/cli.exr
same out/api_coc.exr out/cli_coc.exr
same out/api_confidence.exr out/cli_confidence.exr
echo "The library renders what the command line renders."
