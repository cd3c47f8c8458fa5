// The whole API as a user sees it: api PICTURE (R, G, B, Z) FOLDER VERSION. Exits with 1 where
// something is not as the headers say; what it writes to FOLDER library_test.sh compares.
#include <defray/defray.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "expectations.h"

namespace {

using defray::Device;
using defray::ErrorKind;

/// A ramp of colour in front of a far wall, with a near square.
struct Scene {
  static constexpr int width = 24, height = 16, count = width * height;
  std::vector<float> red = std::vector<float>(count), green = red, blue = red, depth = red;

  Scene() {
    for (int i = 0; i < count; ++i) {
      const int x = i % width, y = i / width;
      const bool is_near = x > 6 && x < 14 && y > 4 && y < 11;
      const auto k = static_cast<std::size_t>(i);
      red[k] = static_cast<float>(x) / width;
      green[k] = static_cast<float>(y) / height;
      blue[k] = is_near ? 1.0f : 0.25f;
      depth[k] = is_near ? 1.0f : 5.0f;
    }
  }
  defray::Picture picture() const {
    defray::Picture p;
    p.data = {0, 0, width, height};
    p.colour = {red, green, blue};
    p.depth = depth;
    return p;
  }
};

defray::Lens wide_open() {
  defray::Lens lens;
  lens.focal_length_mm = 50;
  lens.sensor_width_mm = 5;
  lens.aperture_diameter_mm = 35;
  lens.focus_distance_units = 5;
  return lens;
}

bool are_equal(const defray::RenderResult& a, const defray::RenderResult& b) {
  return a.colour == b.colour && a.coc_px == b.coc_px && a.confidence == b.confidence &&
         a.nearest == b.nearest;
}

void check_results(Device& device) {
  const Scene scene;
  defray::Options options;
  options.wants_nearest = true;
  double share = 0;
  const auto result = defray::render(device, scene.picture(), wide_open(), options,
                                     [&](double done) { share = done; });
  expect(share == 1, "progress ends at 1");
  expect(result.colour.size() == 3 && result.colour[0].size() == Scene::count, "planes are whole");
  expect(result.colour[2] != scene.blue, "the near square is out of focus");
  expect(result.coc_px[0] == 0 && result.coc_px[Scene::width * 7 + 10] < 0, "CoCs are signed");
  expect(result.report.nearest_coc_px == double{result.coc_px[Scene::width * 7 + 10]},
         "the report has the largest CoC in front");
  expect(result.confidence.size() == Scene::count && result.nearest.size() == Scene::count,
         "confidence and nearest hits are whole");
  expect(result.report.chain && result.report.chain->lens_points > 100, "the report has stages");
  expect(result.report.depth.farthest_units == 5, "the report has the depth's range");

  expect(!result.report.expected && result.expected_error.empty(), "no error is found unasked");
  options.error.wants_expected = options.error.wants_planes = true;
  const auto expecting = defray::render(device, scene.picture(), wide_open(), options);
  expect(expecting.report.expected && expecting.report.expected->psnr_db > 10,
         "an error is expected");
  expect(expecting.expected_error.size() == 5 && expecting.expected_error[0].size() == Scene::count,
         "of each pixel, by cause");
  options.error = {false, false, 5};
  const auto targeted = defray::render(device, scene.picture(), wide_open(), options);
  expect(targeted.report.expected->quality == defray::Quality::preview, "a target chooses");
  expect(targeted.expected_error.empty(), "planes are for who wants them");
  options.error = {};

  Device reference = Device::reference();
  expect(reference.name() == "the scalar reference", "the reference has a name");
  expect(are_equal(result, defray::render(reference, scene.picture(), wide_open(), options)),
         "the reference has the same bits");
  device.set_memory(1 << 20);
  device.set_work_group(16, 2);
  device.set_work_group("rdb_merge", 8, 1);
  expect(are_equal(result, defray::render(device, scene.picture(), wide_open(), options)),
         "memory and work-groups change no bit");
  device.set_work_group(0, 0);
}

void check_methods(Device& device) {
  const Scene scene;
  defray::Options options;
  const auto render = [&] {
    return defray::render(device, scene.picture(), wide_open(), options).colour;
  };
  const auto whole = render();
  options.chain = settings_for(defray::Quality::draft);
  const auto draft = render();
  options.chain.reset();
  const auto literal = render();
  options.method = defray::Method::linear;
  const auto linear = render();
  options.method = defray::Method::gather;
  const auto gather = render();
  options.method = defray::Method::tiltshift;
  const auto tiltshift = render();
  const std::vector<std::vector<std::vector<float>>> all{whole,  draft,  literal,
                                                         linear, gather, tiltshift};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) expect(all[i] != all[j], "each method has its own picture");
  }
  expect(defray::all_methods().size() == 4 && !defray::has_lens(options.method),
         "methods say whether they have a lens");
  expect(defray::to_string(options.method) == std::string("tiltshift"), "methods have names");
}

void check_splats(Device& device) {
  const defray::SplatModel model(defray::make_point_cloud("figure", 500));
  expect(model.points() == 500 && model.notes().empty(), "all points have a place");
  defray::SplatSettings settings;
  settings.width = 40;
  settings.height = 30;
  defray::Lens lens = wide_open();
  const defray::CameraPose pose = defray::framing_pose(model, lens, settings);
  lens.focus_distance_units = pose.from[2];
  double share = 0;
  const auto result =
      defray::splat(device, model, pose, lens, settings, [&](double done) { share = done; });
  expect(share == 1, "progress of splats ends at 1");
  expect(result.colour.size() == 4 && result.colour[3].size() == 1200, "splats make four planes");
  expect(result.colour[3][15 * 40 + 20] > 0.9f, "the model is in the middle");
  expect(result.report.points == 500 && result.report.seen > 0, "splats are counted");
  Device reference = Device::reference();
  expect(defray::splat(reference, model, pose, lens, settings).colour == result.colour,
         "the reference's splats have the same bits");
  expect_error(ErrorKind::input, "the cloud has no points",
               [] { defray::SplatModel model{defray::PointCloud{}}; });
  expect_error(ErrorKind::usage, "cutoff is 0", [&] {
    settings.cutoff = 0;
    defray::splat(device, model, pose, lens, settings);
  });
}

void check_inputs(Device& device) {
  Scene scene;
  const auto colour = [&](const defray::Options& options) {
    return defray::render(device, scene.picture(), wide_open(), options).colour;
  };
  defray::Options options;
  const auto plain = colour(options);
  std::vector<float> z = scene.depth;
  for (float& value : scene.depth) value = 1 / value;
  options.depth.kind = defray::DepthKind::inverse;
  expect(colour(options) == plain, "inverse depth is understood");
  scene.depth = z;

  scene.red[5] = std::numeric_limits<float>::quiet_NaN();
  const auto result = defray::render(device, scene.picture(), wide_open());
  expect(result.report.nonfinite == 1 && std::isfinite(result.colour[0][5]), "NaN becomes 0");
  options = {};
  options.nonfinite = defray::Nonfinite::keep;
  expect(std::isnan(colour(options)[0][5]), "NaN is kept");
  options.nonfinite = defray::Nonfinite::error;
  expect_error(ErrorKind::input, "the picture: colour nan at pixel (5, 0)",
               [&] { colour(options); });
}

void check_messages(Device& device) {
  const Scene scene;
  const auto picture_error = [&](const std::string& part, auto&& change) {
    defray::Picture picture = scene.picture();
    change(picture);
    expect_error(ErrorKind::usage, part, [&] { defray::render(device, picture, wide_open()); });
  };
  picture_error("the data window 0x0+0+0 has no pixels", [](auto& p) { p.data = {}; });
  picture_error("the display window -1x4+0+0 has no pixels", [](auto& p) {
    p.display = {0, 0, -1, 4};
  });
  picture_error("a picture has 1 to 4 planes of colour, not 0", [](auto& p) { p.colour = {}; });
  picture_error("a plane of colour has 383 values: the data window 24x16+0+0 has 384 pixels",
                [](auto& p) { p.colour[1] = p.colour[1].first(383); });
  picture_error("the depth plane has 0 values", [](auto& p) { p.depth = {}; });
  const auto options_error = [&](const std::string& part, auto&& change) {
    defray::Options options;
    change(options);
    expect_error(ErrorKind::usage, part,
                 [&] { defray::render(device, scene.picture(), wide_open(), options); });
  };
  options_error("blades", [](auto& o) { o.chain->aperture.blades = 99; });
  options_error("samples",
                [](auto& o) { o.method = defray::Method::gather, o.gather.samples = 0; });
  options_error("near", [](auto& o) { o.depth.kind = defray::DepthKind::normalized; });
  expect_error(ErrorKind::usage, "focus",
               [&] { defray::render(device, scene.picture(), defray::Lens()); });

  expect_error(ErrorKind::device, "no OpenCL device is called 'abacus'",
               [] { Device::open("abacus"); });
  expect_error(ErrorKind::usage, "memory is 0", [&] { device.set_memory(0); });
  expect_error(ErrorKind::usage, "work_group: kernel 'mixd' is not known. Did you mean 'mixed'?",
               [&] { device.set_work_group("mixd", 8, 8); });
  expect_error(ErrorKind::usage, "work-items", [&] { device.set_work_group(100000, 1); });
  expect_error(ErrorKind::usage, "no quality 9", [] { defray::settings_for(defray::Quality(9)); });
  Device reference = Device::open("reference");
  expect_error(ErrorKind::usage, "memory means nothing to device reference",
               [&] { reference.set_memory(1); });
  expect_error(ErrorKind::usage, "work_group means nothing to device reference",
               [&] { reference.set_work_group(8, 8); });
}

/// The picture in memory and from file to file.
void check_files(Device& device, const std::string& input, const std::string& folder) {
  defray::PictureFile file = defray::PictureFile::read(input);
  defray::Lens lens = wide_open();
  const auto result = defray::render(device, file.picture(), lens);
  expect(file.write(folder + "/api.exr", result.colour).empty(), "nothing is left out");
  file.write_plane(folder + "/api_coc.exr", "coc", result.coc_px);
  file.write_plane(folder + "/api_confidence.exr", "confidence", result.confidence);
  expect(!file.write(folder + "/api.png", result.colour).empty(), "PNG leaves depth out");

  defray::RenderSettings settings;
  settings.camera.focal_length_mm = lens.focal_length_mm;
  settings.camera.sensor_width_mm = lens.sensor_width_mm;
  settings.camera.aperture_diameter_mm = lens.aperture_diameter_mm;
  settings.camera.focus_distance_units = lens.focus_distance_units;
  const auto frame =
      defray::render_file(device, {input, "", folder + "/file.exr", "", ""}, settings);
  expect(frame.colour == result.colour, "render_file has the bits of render");
  expect(frame.report.depth_channel == "Z" && frame.report.chain, "files have a report");

  defray::FileRender steps({input, "", folder + "/steps.exr", "", ""}, settings);
  expect_error(ErrorKind::usage, "read() comes before render()", [&] { steps.render(device); });
  std::thread([&] { steps.read(); }).join();
  expect_error(ErrorKind::usage, "render() comes before write()", [&] { steps.write(); });
  steps.render(device);
  defray::FrameResult written;
  std::thread([&] { written = steps.write(); }).join();
  expect(written.colour == result.colour, "steps have the bits of render_file");

  expect_error(ErrorKind::input, "none.exr", [] { defray::PictureFile::read("none.exr"); });
  expect_error(ErrorKind::usage, "has R G B (3 planes), the colour to write has 0",
               [&] { file.write(folder + "/x.exr", {}); });
  expect_error(ErrorKind::usage, "a plane to write has 1 values, planes of the picture read have",
               [&] {
                 file.write(folder + "/x.exr", {{1}, {1}, {1}});
               });
  expect_error(ErrorKind::usage, "coc has 0 values, planes of the picture read have",
               [&] { file.write_plane(folder + "/x.exr", "coc", {}); });
  expect_error(ErrorKind::usage, "x.gif", [&] { file.write(folder + "/x.gif", result.colour); });
  expect_error(ErrorKind::output, "nowhere",
               [&] { file.write(folder + "/nowhere/x.exr", result.colour); });
}

}  // namespace

int main(int, char** arguments) try {
  expect(defray::version() == std::string(arguments[3]), "the version is the project's");
  const auto devices = Device::list();
  expect(!devices.empty() && devices[0].compute_units > 0, "there is a device");
  Device device = Device::open();
  Device fast = Device::open(device.name(), {defray::Math::fast});
  expect(fast.name() == device.name() + " (fast arithmetic)", "fast arithmetic shows");
  check_results(device);
  check_methods(device);
  check_inputs(device);
  check_messages(device);
  check_splats(device);
  check_files(device, arguments[1], arguments[2]);
  return failures > 0;
} catch (const defray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
