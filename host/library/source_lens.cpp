#include "library/source_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "lens/camera.h"
#include "lens/camera_metadata.h"
#include "lens/depth.h"
#include "lens/depth_steps.h"
#include "library/frame_notes.h"

namespace defray {
namespace {

constexpr int patch_radius = 2;  ///< Of the depths around a place to focus on.

/// The median of the depths there, background left out.
double depth_at(const PixelPlace& place, const Plane& depth, const PartInfo& part,
                const std::string& path) {
  const Window& data = part.data;
  const int x = part.display.x + place.x - data.x, y = part.display.y + place.y - data.y;
  if (x < 0 || y < 0 || x >= data.width || y >= data.height) {
    fail(ErrorKind::usage, "{} {},{}: {} has pixels from {},{} to {},{}", field("focus_at"),
         place.x, place.y, path, data.x - part.display.x, data.y - part.display.y,
         data.x - part.display.x + data.width - 1, data.y - part.display.y + data.height - 1);
  }
  std::vector<float> found;
  for (int v = std::max(y - patch_radius, 0); v <= std::min(y + patch_radius, data.height - 1);
       ++v) {
    for (int u = std::max(x - patch_radius, 0); u <= std::min(x + patch_radius, data.width - 1);
         ++u) {
      const float z = depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(data.width) +
                            static_cast<std::size_t>(u)];
      if (std::isfinite(z)) found.push_back(z);
    }
  }
  if (found.empty()) {
    fail(ErrorKind::input, "{}: {} {},{} is background: choose a place where there is something",
         path, field("focus_at"), place.x, place.y);
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>((found.size() - 1) / 2);
  std::nth_element(found.begin(), middle, found.end());
  return static_cast<double>(*middle);
}

/// The camera without what a focus decides: enough to tell distances along rays.
CameraValues before_focus(CameraValues camera) {
  camera.focus_distance_units = std::numeric_limits<double>::infinity();
  camera.focus_end_units.reset();
  camera.perceived_distance_m.reset();
  return camera;
}

CameraValues camera_of(const ImageFile& file, const RenderSettings& settings) {
  if (!settings.camera_from_metadata) return settings.camera;
  const CameraValues& stated = settings.camera;
  const CameraValues found = camera_from_metadata(
      file, settings.metres_per_unit, settings.focus_at ? before_focus(stated) : stated);
  CameraValues camera = found.overridden_by(stated);
  if (found.fit) camera.fit = found.fit;  // it goes with the field of view that was found
  // Metadata have the width's own.
  if (found.sensor_width_mm && !camera.fit) camera.fit = SensorFit::horizontal;
  return camera;
}

/// Takes the steps out of a depth that was stored in steps, where they would show.
void smooth_depth(DepthPlane& depth, DepthLadder ladder, int width, const DepthSettings& settings,
                  FrameReport& report) {
  if (ladder.steps.empty()) return;
  convert(ladder, settings);
  const DepthSteps steps =
      smooth_steps(depth.values, ladder, width, report.lens, report.display.width);
  if (steps.smoothed == 0) return;
  const int bits = depth.integer_bits;
  report.notes.push_back(
      fmt::format("the depth {}, whose steps change the CoC by up to {:.3g} px: smoothed within a "
                  "step in {} px; "
                  "render it as 32-bit float",
                  bits > 0 ? fmt::format("has {} bits", bits) : "is in half floats",
                  steps.largest_px, steps.smoothed));
  depth.is_smoothed = true;
}

}  // namespace

Window lens_window(const PartInfo& part, const RenderSettings& settings, const std::string& path) {
  if (!settings.full_size) return part.display;
  const Window& full = *settings.full_size;
  const Window& data = part.data;
  if (full.x < 0 || full.y < 0 || full.x + data.width > full.width ||
      full.y + data.height > full.height) {
    fail(ErrorKind::input, "{}: has {}x{} pixels, which do not fit into {} {}", path, data.width,
         data.height, field("full_size"), to_string(full));
  }
  return {data.x - full.x, data.y - full.y, full.width, full.height};
}

void take_lens(const ImageFile& file, const PartInfo& part, DepthPlane& depth,
               const RenderSettings& settings, const std::string& path, FrameReport& report) {
  CameraValues camera = camera_of(file, settings);
  const auto lens_of = [&](const CameraValues& values) {
    return make_lens(values, settings.metres_per_unit, settings.model, settings.max_coc_px,
                     report.display);
  };
  report.lens = lens_of(settings.focus_at ? before_focus(camera) : camera);
  DepthLadder ladder;
  if (depth.integer_bits <= 16) {
    ladder = ladder_of_stored(depth.values, depth.integer_bits, settings.depth);
  }
  report.depth =
      convert_depth(depth.values, settings.depth, part.data, report.display, report.lens, path);
  if (settings.focus_at) {
    camera.focus_distance_units = depth_at(*settings.focus_at, depth.values, part, path);
    camera.focus_end_units.reset();
    report.lens = lens_of(camera);
  }
  std::vector<std::string>& notes = report.notes;
  smooth_depth(depth, std::move(ladder), part.data.width, settings.depth, report);
  notes.insert(notes.end(), camera.notes.begin(), camera.notes.end());
  for (std::string& note : notes_on_extremes(camera)) notes.push_back(std::move(note));
  if (const std::string upright = note_on_upright(camera, report.display); !upright.empty()) {
    notes.push_back(upright);
  }
  note_depth(depth, settings.depth, report.depth, notes);
  note_focus(report.lens, report.depth, notes);
}

}  // namespace defray
