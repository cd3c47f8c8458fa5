#include "compare/comparison.h"

#include <algorithm>

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

/// The edge band of the pinhole frame that `picture` was rendered from.
Mask read_band(const CompareOptions& o, const ColourFile& picture) {
  const ImageFile file = ImageFile::read(o.depth, Content::data);
  const ChannelName name = choose_depth(o.depth, file.parts(), {"", "", o.depth_channel}, {});
  const PartInfo& part = file.parts()[static_cast<std::size_t>(name.part)];
  require_same_size({o.depth, {}, part.data, part.display}, picture);
  const CameraValues camera = read_camera_file(o.camera, o.focus_setting, 1);
  const Lens lens = make_lens(camera, 1, LensModel::cg, 0, part.display);
  Plane depth = file.plane(name.part, name.channel);
  const int width = part.display.width;
  convert_depth(depth, {}, part.data, part.display, pixel_focal_length(lens, width), o.depth);
  return edge_band(depth, part.data.width, reference::TwinBackend().coc(lens, width, depth).host(),
                   o.edge_step);
}

/// 1 where the mask's first channel is above a half.
Mask read_mask(const CompareOptions& o, const Window& data) {
  const ImageFile file = ImageFile::read(o.mask, Content::data);
  const PartInfo& part = file.parts().front();
  const Plane values = to_display_window({file.plane(0, 0)}, part.data, data).front();
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

/// Of all pixels; places are of the pictures.
Found compare_all(const CompareOptions& o, const Pair& pair, const Pair* before) {
  const std::vector<Plane>&a = pair.a.planes, &b = pair.b.planes;
  const int width = pair.a.data.width;
  Found found;
  found.comparison = compare(a, b, width);
  if (!o.false_edges) return found;
  found.false_edges = false_edges(a, b, width);
  if (!before) return found;
  require_same_size(before->a, pair.a);
  found.false_changes = false_changes(before->a.planes, a, before->b.planes, b, width);
  return found;
}

/// The same of a mask's pixels.
Found compare_masked(const CompareOptions& o, const Pair& pair, const Pair* before) {
  const Mask mask = read_mask(o, pair.a.data);
  std::optional<Pair> seen_before;
  if (before) seen_before = masked(*before, mask);
  Found found = compare_all(o, masked(pair, mask), seen_before ? &*seen_before : nullptr);
  static_cast<Errors&>(found.comparison) = errors_where(pair.a.planes, pair.b.planes, mask, 1);
  return found;
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
  if (!o.depth.empty()) require_same_size(pair.a, pair.b);
  bring_together({&pair.a, &pair.b}, region);
  return pair;
}

Found compare_pair(const CompareOptions& o, const Pair& pair, const Pair* before) {
  Found found = o.mask.empty() ? compare_all(o, pair, before) : compare_masked(o, pair, before);
  const ColourFile& a = pair.a;
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
