#include "compare/comparison.h"

#include <algorithm>

#include "base/error.h"
#include "image/channels.h"
#include "image/output.h"
#include "image/sequence.h"
#include "lens/camera.h"
#include "lens/depth.h"
#include "measure/edge_band.h"
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
  const Lens lens =
      make_lens(read_camera_json(o.camera, o.focus_setting, 1), 1, LensModel::cg, 0, part.display);
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

/// `b`, but `a` where the mask is not: outside, both pictures are alike.
std::vector<Plane> masked(const Pair& pair, const Mask& mask) {
  std::vector<Plane> planes = pair.b.planes;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (!mask[i]) planes[c][i] = pair.a.planes[c][i];
    }
  }
  return planes;
}

/// What is looked at: b without what the mask leaves out.
std::vector<Plane> seen_b(const Pair& pair, const Mask& mask) {
  return mask.empty() ? pair.b.planes : masked(pair, mask);
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
  const ColourFile& a = pair.a;
  const ColourFile& b = pair.b;
  const int width = a.data.width;
  const Mask mask = o.mask.empty() ? Mask() : read_mask(o, a.data);
  const std::vector<Plane> planes = seen_b(pair, mask);
  Found found;
  found.comparison = compare(a.planes, planes, width);
  if (!mask.empty()) {
    static_cast<Errors&>(found.comparison) = errors_where(a.planes, b.planes, mask, 1);
  }
  if (!o.depth.empty()) {
    const Mask band = read_band(o, a);
    found.band = {errors_where(a.planes, b.planes, band, 1),
                  errors_where(a.planes, b.planes, band, 0)};
  }
  if (o.false_edges) found.false_edges = false_edges(a.planes, planes, width);
  if (o.false_edges && before) {
    require_same_size(before->a, a);
    found.false_changes =
        false_changes(before->a.planes, a.planes, seen_b(*before, mask), planes, width);
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
