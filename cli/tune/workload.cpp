#include "tune/workload.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lens/lens.h"
#include "options/words.h"
#include "scenes/scene.h"
#include "scenes/tracing/render.h"
#include "tuning/results.h"

namespace defray::cli {
namespace {

constexpr double narrow_px = 10, wide_px = 40;
struct PictureSize {
  int width, height;
  bool operator==(const PictureSize&) const = default;
};
constexpr PictureSize small_picture{96, 64};

const WordTable<Method> method_names{
    {"rdb", Method::rdb}, {"gather", Method::gather}, {"linear", Method::linear}};
const WordTable<PictureSize> sizes{
    {"small", {640, 480}}, {"hd", {1920, 1080}}, {"uhd", {3840, 2160}}};

/// A built-in scene as a lens takes it.
struct BuiltIn {
  ScenePicture pinhole;
  Picture picture;
  Lens lens;
};

/// Its lens opened until the largest circle has this radius.
std::shared_ptr<const BuiltIn> built_in(const std::string& name, PictureSize size, double coc_px) {
  const Scene scene = make_scene(name, size.width, size.height);
  auto made = std::make_shared<BuiltIn>();
  made->pinhole = render_pinhole(scene);
  for (const Plane& plane : made->pinhole.colour) made->picture.colour.emplace_back(plane);
  made->picture.depth = made->pinhole.depth;
  made->picture.data = {0, 0, size.width, size.height};
  made->lens = lens_of(scene, scene.settings.front());
  const double focus = made->lens.focus_distance_units;
  double largest = 0;
  for (const float z : made->pinhole.depth) {
    largest = std::max(largest, std::abs(1 - focus / static_cast<double>(z)));
  }
  made->lens.aperture_diameter_mm *= coc_px / (largest * background_coc_px(made->lens, size.width));
  return made;
}

std::function<Drawn(Device&)> drawn_by(const Options& options,
                                       std::shared_ptr<const BuiltIn> scene) {
  return [options, scene](Device& device) {
    return render(device, scene->picture, scene->lens, options).colour;
  };
}

Workload workload_of(const std::string& method, const std::string& scene, PictureSize size,
                     double coc_px) {
  const auto frame = built_in(scene, size, coc_px);
  const auto small = built_in(scene, small_picture, coc_px / 4);
  const Options options = options_of(method);
  return {
      fmt::format("{}, {}, {}x{}, CoC up to {} px", method, scene, size.width, size.height, coc_px),
      tuning::frame_class(frame->pinhole.depth.size(), coc_px), drawn_by(options, frame),
      drawn_by(options, small)};
}

Workload splat_workload(PictureSize size) {
  const auto model = std::make_shared<const SplatModel>(make_point_cloud("figure"));
  const auto draw = [model](PictureSize of) {
    SplatSettings settings;
    settings.width = of.width;
    settings.height = of.height;
    Lens lens;
    lens.aperture_diameter_mm = 100;
    lens.focus_distance_units = 1;  // until it is known how far away it stands
    const CameraPose pose = framing_pose(*model, lens, settings);
    lens.focus_distance_units = pose.from[2] - pose.look_at[2];
    return [model, pose, lens, settings](Device& device) {
      return splat(device, *model, pose, lens, settings).colour;
    };
  };
  const std::size_t pixels =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  return {fmt::format("splat, figure, {}x{}", size.width, size.height), tuning::cloud_class(pixels),
          draw(size), draw(small_picture)};
}

}  // namespace

Options options_of(const std::string& method) {
  WordTable<Method> names = method_names;
  names.emplace_back("splat", Method::rdb);  // for the message: it is not of pictures
  Options options;
  options.method = choice<Method>("--methods", method, names);
  if (options.method != Method::rdb) options.chain.reset();
  return options;
}

std::vector<Workload> built_in_workloads(const std::string& method, const std::string& size) {
  const PictureSize pixels = choice<PictureSize>("--sizes", size, sizes);
  if (method == "splat") return {splat_workload(pixels)};
  return {workload_of(method, "spheres", pixels, narrow_px),
          workload_of(method, "fence", pixels, wide_px)};
}

Workload own_workload(Device& device, std::shared_ptr<const PictureFile> file,
                      const std::string& name, const Lens& lens, const Options& options) {
  const std::string method = to_string(options.method);
  const RenderReport report = render(device, file->picture(), lens, options).report;
  const double largest_px =
      std::max(std::abs(report.nearest_coc_px), std::abs(report.farthest_coc_px));
  return {fmt::format("{}, {}, CoC up to {:.3g} px", method, name, largest_px),
          tuning::frame_class(file->picture().depth.size(), largest_px),
          [=](Device& d) { return render(d, file->picture(), lens, options).colour; },
          drawn_by(options, built_in("spheres", small_picture, narrow_px / 4))};
}

}  // namespace defray::cli
