#include "truth/two_truths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/srgb.h"
#include "scenes/tracing/render.h"

namespace defray::perf {

TwoTruths make_two_truths(const Subject& s, int rays) {
  return {render_truth(s.scene, s.lens, rays, 1).colour,
          render_truth(s.scene, s.lens, rays, 2).colour};
}

Plane square_errors(const std::vector<Plane>& picture, const TwoTruths& truths) {
  Plane out(picture[0].size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double value = shown_value(picture[c][i]);
      out[i] += static_cast<float>((value - shown_value(truths.first[c][i])) *
                                   (value - shown_value(truths.second[c][i])) / 3);
    }
  }
  return out;
}

double mean_of(const Plane& plane) {
  return std::accumulate(plane.begin(), plane.end(), 0.0) / static_cast<double>(plane.size());
}

double psnr_of(double square_error) { return -10 * std::log10(std::max(square_error, 1e-9)); }

}  // namespace defray::perf
