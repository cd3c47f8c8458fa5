// camera.json. First line: the focus setting asked for; the rest: the file.
#include "lens/camera.h"

#include "fuzz.h"

using namespace defray;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const std::string setting = bytes.line();
  const std::string text = bytes.rest();
  fuzz::run_parser([&] {
    const CameraValues values = parse_camera_json(text, "camera.json", setting, 0.01);
    fuzz::require(!(values.fstop && values.aperture_diameter_mm));
  });
  fuzz::run_parser([&] { parse_camera_pose(text, "camera.json", 0.01); });
  return 0;
}
