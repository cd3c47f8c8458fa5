#include "library/lens_frame.h"

#include <algorithm>
#include <cstdlib>

#include "lens/coc.h"
#include "methods/tiltshift.h"
#include "tuning/results.h"

namespace defray {
namespace {

Frame placed(PinholePicture picture) {
  Frame f;
  f.channels = std::move(picture.channels);
  f.depth = std::move(picture.depth);
  f.width = picture.data.width;
  f.height = picture.data.height;
  f.has_alpha = f.channels.size() % 2 == 0;
  f.origin_x = picture.data.x - picture.display.x;
  f.origin_y = picture.data.y - picture.display.y;
  f.display_width = picture.display.width;
  f.display_height = picture.display.height;
  return f;
}

void describe_coc(std::span<const std::int32_t> coc, RenderReport& report) {
  const auto [smallest, largest] = std::minmax_element(coc.begin(), coc.end());
  constexpr double quantum = 1.0 / (1 << DEFRAY_COC_FRACTION_BITS);
  report.nearest_coc_px = *smallest * quantum;
  report.farthest_coc_px = *largest * quantum;
}

/// Between the ends of what is kept sharp nothing is blurred, outside by the CoC of the nearer end.
Values<std::int32_t> coc_of(const Lens& lens, int display_width, const Values<float>& depth,
                            Backend& backend) {
  Values<std::int32_t> nearer = backend.coc(lens, display_width, depth);
  if (lens.focus_end_units == 0) return nearer;
  Lens end = lens;
  end.focus_distance_units = lens.focus_end_units;
  const Values<std::int32_t> farther = backend.coc(end, display_width, depth);
  const auto from = nearer.host(), to = farther.host();
  std::vector<std::int32_t> coc(from.size());
  for (std::size_t i = 0; i < coc.size(); ++i) coc[i] = std::min(from[i], 0) + std::max(to[i], 0);
  return coc;
}

}  // namespace

Frame lens_frame(PinholePicture picture, const Lens& lens, Backend& backend, RenderReport& report) {
  Frame f = placed(std::move(picture));
  f.coc_quanta = coc_of(lens, f.display_width, f.depth, backend);
  const auto coc = f.coc_quanta.host();
  describe_coc(coc, report);
  const auto limit = static_cast<std::int32_t>(coc_params(lens, f.display_width, 0).limit_quanta);
  report.coc_limited = static_cast<std::size_t>(
      std::count_if(coc.begin(), coc.end(), [&](auto q) { return std::abs(q) == limit; }));
  return f;
}

Frame lens_frame(PinholePicture picture, const TiltshiftSettings& tiltshift, Backend& backend,
                 RenderReport& report) {
  Frame f = placed(std::move(picture));
  f.coc_quanta = backend.tiltshift(
      tiltshift_params(tiltshift, f.width, f.height, f.origin_y, f.display_height));
  describe_coc(f.coc_quanta.host(), report);
  return f;
}

std::string class_of(const Frame& frame, const RenderReport& report) {
  return tuning::frame_class(
      frame.pixels(), std::max(std::abs(report.nearest_coc_px), std::abs(report.farthest_coc_px)));
}

}  // namespace defray
