#include <defray/defray.h>

#include <cstdio>

int main(int count, char** names) try {
  if (count != 3) return std::puts("usage: example IN.exr OUT.exr"), 2;
  auto file = defray::PictureFile::read(names[1]);
  const auto& in = file.picture();
  defray::Picture picture{.data = in.data};  // and spans of floats: any renderer's planes will do
  picture.colour = {in.colour[0], in.colour[1], in.colour[2]};
  picture.depth = in.depth;
  defray::Lens lens{.focal_length_mm = 50, .aperture_diameter_mm = 35, .focus_distance_units = 1.2};
  auto device = defray::Device::open();
  const auto result = defray::render(device, picture, lens);
  std::printf("CoC from %.1f px on\n", result.report.nearest_coc_px);
  file.write(names[2], result.colour);
} catch (const defray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
