// Twin of kernels/methods/linear_psf.cl: Shinya 1994, eq. 5, with the disc of one pixel's soft
// border.
#include <algorithm>
#include <cmath>

#include "methods/linear.h"
#include "reference/reference.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

template <typename Real>
Real soft_disc(Real radius, int dx, int dy) {
  const Real distance = std::sqrt(static_cast<Real>(dx * dx + dy * dy));
  return std::clamp(radius + Real(0.5) - distance, Real(0), Real(1));
}

/// Sum of the disc over all pixels, one by one.
double disc_sum(double radius) {
  const int reach = static_cast<int>(radius + 0.5);
  double sum = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) sum += soft_disc(radius, dx, dy);
  }
  return sum;
}

}  // namespace

template <typename Real>
std::vector<std::vector<Real>> linear(const Frame& f) {
  const int width = f.width, height = f.height;
  const auto coc_quanta = f.coc_quanta.host();
  const Planes& channels = f.channels;
  const int reach = linear_reach(coc_quanta);
  std::vector<Real> radius(coc_quanta.size());
  std::vector<std::vector<Real>> scaled(channels.size(), std::vector<Real>(radius.size()));
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double r =
        std::ldexp(std::abs(static_cast<double>(coc_quanta[i])), -DEFRAY_COC_FRACTION_BITS);
    radius[i] = static_cast<Real>(r);
    const Real twice = static_cast<Real>(2 * disc_sum(r));
    for (std::size_t c = 0; c < channels.size(); ++c) scaled[c][i] = Real(channels[c][i]) / twice;
  }
  std::vector<std::vector<Real>> out(channels.size(), std::vector<Real>(radius.size(), Real(-0.0)));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x);
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const auto source_y = static_cast<std::size_t>(std::clamp(y + dy, 0, height - 1));
          const auto source_x = static_cast<std::size_t>(std::clamp(x + dx, 0, width - 1));
          const std::size_t source = source_y * static_cast<std::size_t>(width) + source_x;
          const Real weight = 2 * soft_disc(radius[source], dx, dy);
          if (!(weight > 0)) continue;
          for (std::size_t c = 0; c < out.size(); ++c) out[c][at] += weight * scaled[c][source];
        }
      }
    }
  }
  return out;
}

template std::vector<std::vector<float>> linear<float>(const Frame&);
template std::vector<std::vector<double>> linear<double>(const Frame&);

Planes TwinBackend::linear(const Frame& f, const Progress&) { return reference::linear<float>(f); }

}  // namespace defray::reference
