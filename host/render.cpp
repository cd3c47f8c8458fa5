#include "render.h"

#include <algorithm>
#include <cstdlib>

#include "lens/coc.h"

namespace defray {
namespace {

Frame frame_of(RenderJob& job) {
  Frame f = std::move(job.frame);
  f.width = job.data.width;
  f.height = job.data.height;
  f.has_alpha = f.channels.size() == 4;
  f.origin_x = job.data.x - job.display.x;
  f.origin_y = job.data.y - job.display.y;
  f.display_width = job.display.width;
  f.display_height = job.display.height;
  return f;
}

Quanta coc_of(const RenderJob& job, const Frame& f, Backend& backend) {
  if (job.method.method == Method::tiltshift) {
    return backend.tiltshift(
        tiltshift_params(job.tiltshift, f.width, f.height, f.origin_y, f.display_height));
  }
  return backend.coc(job.lens, f.display_width, f.depth);
}

void describe_coc(const RenderJob& job, Rendered& out) {
  const auto coc = out.frame.coc_quanta.host();
  const auto [smallest, largest] = std::minmax_element(coc.begin(), coc.end());
  constexpr double quantum = 1.0 / (1 << DEFRAY_COC_FRACTION_BITS);
  out.nearest_coc_px = *smallest * quantum;
  out.farthest_coc_px = *largest * quantum;
  const auto limit =
      static_cast<std::int32_t>(coc_params(job.lens, job.display.width, 0).limit_quanta);
  out.coc_limited = static_cast<std::size_t>(
      std::count_if(coc.begin(), coc.end(), [&](auto q) { return std::abs(q) == limit; }));
}

}  // namespace

void describe(const Rendered& rendered, const MethodSettings& method, RenderReport& report) {
  report.nearest_coc_px = rendered.nearest_coc_px;
  report.farthest_coc_px = rendered.farthest_coc_px;
  report.coc_limited = rendered.coc_limited;
  if (method.method == Method::rdb && method.chain) report.chain = rendered.result.report;
}

Rendered render(RenderJob job, Backend& backend, const Progress& progress) {
  Rendered out;
  out.frame = frame_of(job);
  out.frame.coc_quanta = coc_of(job, out.frame, backend);
  describe_coc(job, out);
  out.result = apply_method(out.frame, job.method, backend, job.wants_nearest, progress);
  return out;
}

}  // namespace defray
