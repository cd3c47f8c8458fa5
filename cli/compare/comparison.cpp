#include "compare/comparison.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/channels.h"
#include "image/output.h"
#include "image/sequence.h"
#include "lens/camera.h"
#include "lens/depth.h"
#include "measure/edge_band.h"
#include "options/camera_file.h"
#include "reference/twin_backend.h"

namespace defray::cli {
namespace {

using Mask = std::vector<std::uint8_t>;

/// The edge band of the pinhole frame that `picture` was rendered from, whose window may be
/// another.
Mask read_band(const CompareOptions& o, const ColourFile& picture) {
  const ImageFile file = ImageFile::read(o.depth, Content::data);
  const ChannelName name = choose_depth(o.depth, file.parts(), {"", "", o.depth_channel}, {});
  const PartInfo& part = file.parts()[static_cast<std::size_t>(name.part)];
  require_same_display({o.depth, {}, part.data, part.display}, picture);
  const CameraValues camera = read_camera_file(o.camera, o.focus_setting, 1);
  const Lens lens = make_lens(camera, 1, LensModel::cg, 0, part.display);
  // Where there is no depth, 0, there is background.
  const Window all = hull(hull(part.data, part.display), picture.data);
  Plane depth = to_display_window({file.plane(name.part, name.channel)}, part.data, all).front();
  const int width = part.display.width;
  convert_depth(depth, {}, all, part.display, pixel_focal_length(lens, width), o.depth);
  const Mask band = edge_band(depth, all.width,
                              reference::TwinBackend().coc(lens, width, depth).host(), o.edge_step);
  const Plane seen = to_display_window({{band.begin(), band.end()}}, all, picture.data).front();
  return {seen.begin(), seen.end()};
}

/// 1 where the mask's first channel is above a half.
Mask read_mask(const CompareOptions& o, const ColourFile& picture) {
  const ImageFile file = ImageFile::read(o.mask, Content::data);
  const PartInfo& part = file.parts().front();
  require_same_display({o.mask, {}, part.data, part.display}, picture);
  const Plane values = to_display_window({file.plane(0, 0)}, part.data, picture.data).front();
  Mask mask(values.size());
  std::transform(values.begin(), values.end(), mask.begin(), [](float v) { return v > 0.5f; });
  if (std::count(mask.begin(), mask.end(), 1) == 0) {
    fail(ErrorKind::input, "{}: no pixel of the mask is above a half where the pictures are",
         o.mask);
  }
  return mask;
}

/// With a's colours in b where a mask is not: outside, both pictures are alike.
Pair masked(Pair pair, const Mask& mask) {
  for (std::size_t c = 0; c < pair.b.planes.size(); ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (!mask[i]) pair.b.planes[c][i] = pair.a.planes[c][i];
    }
  }
  return pair;
}

/// Of the mask's pixels, if there is one. NaNs differ from all but each other.
std::optional<double> alpha_difference(const Pair& pair, const Mask& mask) {
  if (pair.a.planes.size() != 4 || pair.b.planes.size() != 4) return {};
  const Plane &a = pair.a.planes[3], &b = pair.b.planes[3];
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!mask.empty() && !mask[i]) continue;
    const double difference = std::fabs(double{a[i]} - double{b[i]});
    if (std::isnan(a[i]) != std::isnan(b[i])) return HUGE_VAL;
    most = std::fmax(most, difference);
  }
  return most;
}

/// Of the mask's pixels, if there is one; the place is of the pair's pictures.
Excess changes_since(const CompareOptions& o, Pair before, Pair pair) {
  const Window data = pair.a.data;
  bring_together({&before.a, &before.b, &pair.a, &pair.b}, {});
  if (!o.mask.empty()) {
    const Mask mask = read_mask(o, pair.a);
    before = masked(std::move(before), mask);
    pair = masked(std::move(pair), mask);
  }
  Excess changes = false_changes(before.a.planes, pair.a.planes, before.b.planes, pair.b.planes,
                                 pair.a.data.width);
  changes.worst_x += pair.a.data.x - data.x;
  changes.worst_y += pair.a.data.y - data.y;
  return changes;
}

}  // namespace

CompareOptions CompareOptions::of_frame(int frame) const {
  CompareOptions out = *this;
  for (std::string* path : {&out.a, &out.b, &out.depth, &out.camera, &out.mask, &out.sheet}) {
    *path = frame_path(*path, frame);
  }
  return out;
}

Pair read_pair(const CompareOptions& o) {
  Pair pair{read_colour_file(o.a), read_colour_file(o.b)};
  Region region;
  set_region(region, o.windows, o.crop);
  bring_together({&pair.a, &pair.b}, region);
  return pair;
}

Found compare_pair(const CompareOptions& o, const Pair& pair, const Pair* before) {
  const ColourFile& a = pair.a;
  const int width = a.data.width;
  const Mask mask = o.mask.empty() ? Mask() : read_mask(o, a);
  Found found;
  found.comparison = compare(a.planes, pair.b.planes, width, mask);
  found.alpha_difference = alpha_difference(pair, mask);
  if (o.false_edges) {
    const Pair seen = mask.empty() ? pair : masked(pair, mask);
    found.false_edges = false_edges(seen.a.planes, seen.b.planes, width);
    if (before) found.false_changes = changes_since(o, *before, pair);
  }
  if (!o.depth.empty()) {
    const Mask band = read_band(o, a);
    found.band = {errors_where(a.planes, pair.b.planes, band, 1),
                  errors_where(a.planes, pair.b.planes, band, 0)};
  }
  const auto place = [&](int& x, int& y) {
    x += a.data.x - a.display.x;
    y += a.data.y - a.display.y;
  };
  place(found.comparison.worst_x, found.comparison.worst_y);
  for (std::optional<Excess>* excess : {&found.false_edges, &found.false_changes}) {
    if (*excess) place((*excess)->worst_x, (*excess)->worst_y);
  }
  return found;
}

}  // namespace defray::cli
