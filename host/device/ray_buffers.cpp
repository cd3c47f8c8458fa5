#include "device/ray_buffers.h"

#include <algorithm>

#include "rdb/rdb_plan.h"

namespace defray {

RayBuffers::RayBuffers(Session& session, const Frame& frame, const RayPlan& plan,
                       std::size_t pixels, std::size_t winner_bytes, KeptBuffer& winners)
    : lens(session.view(plan.lens.points)),
      landing_radii(plan.lens.landing_radii.empty() ? lens : session.view(plan.lens.landing_radii)),
      rim_x(plan.rim_x.empty() ? lens : session.view(plan.rim_x)),
      rim_y(plan.rim_y.empty() ? lens : session.view(plan.rim_y)),
      winner(winners.take(session, pixels * std::max(winner_bytes, sizeof(cl_uint)))),
      session_(session),
      frame_(frame),
      plan_(plan) {
  const std::size_t own = session.works_in_host_memory() ? frame.channels.size() : 0;
  for (std::size_t c = own; c < means.size(); ++c) {
    means[c] = session.buffer(pixels * sizeof(cl_float));
  }
  if (own == 0) seen = session.buffer(pixels * sizeof(cl_uint));
  if (plan.wants_nearest) nearest_ = session.buffer(pixels * sizeof(cl_uint2));
}

DefrayRdbParams RayBuffers::params() const {
  DefrayRdbParams p{};
  p.width = word(frame_.width);
  p.jitter_lens = plan_.lens.jitter;
  p.seed = plan_.seed;
  p.layers = word(frame_.layers);
  p.has_coverage = !frame_.coverage.empty();
  p.origin_x = plan_.origin_x;
  p.origin_y = plan_.origin_y;
  p.has_rim = !plan_.rim_x.empty();
  p.has_spans = plan_.has_spans;
  p.has_landing_radii = !plan_.lens.landing_radii.empty();
  p.all_cells = static_cast<std::uint32_t>(plan_.lens.points.size());
  p.has_data_of = !frame_.data_of.empty();
  return p;
}

std::size_t RayBuffers::first_of(const DefrayRdbParams& p) const {
  return std::size_t{p.width} * (p.band_y - word(frame_.wanted_rows().y));
}

void RayBuffers::begin(const DefrayRdbParams& p, RayResult& out) {
  if (!session_.works_in_host_memory()) return;
  const std::size_t first = first_of(p), bytes = std::size_t{p.width} * p.band_rows * 4;
  for (std::size_t c = 0; c < out.means.size(); ++c) {
    means[c] = session_.write_view(&out.means[c][first], bytes);
  }
  seen = session_.write_view(&out.seen[first], bytes);
}

void RayBuffers::read(const DefrayRdbParams& p, RayResult& out) {
  const std::size_t first = first_of(p), count = std::size_t{p.width} * p.band_rows;
  for (std::size_t c = 0; c < out.means.size(); ++c) {
    session_.bring(means[c], count, &out.means[c][first]);
  }
  session_.bring(seen, count, &out.seen[first]);
  if (!plan_.wants_nearest) return;
  const std::size_t window = std::size_t{p.window_y} * p.layers * p.width;
  const auto place = out.nearest.begin() + static_cast<std::ptrdiff_t>(first);
  session_.look_at<RdbWinner>(nearest_, count, [&](std::span<const RdbWinner> nearest) {
    std::transform(nearest.begin(), nearest.end(), place, [&](const RdbWinner& w) {
      return w.source == DEFRAY_EMPTY ? DEFRAY_EMPTY : frame_.data_pixel(window + w.source);
    });
  });
}

}  // namespace defray
