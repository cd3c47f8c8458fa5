// Twins of kernels/rdb_scatter.cl and kernels/rdb_merge.cl: Shinya 1994, section 4, steps 2 to 5.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/pcg3d.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

struct Offset {
  double u, v;
};

/// Offset of a target pixel's lens samples: uniform in [-half, half)^2 in steps of the lens unit.
Offset jitter_offset(int x, int y, std::uint32_t seed, std::int32_t half) {
  const auto hash = pcg3d(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed);
  const double unit = std::ldexp(1.0, -DEFRAY_LENS_FRACTION_BITS);
  const auto offset = [&](std::uint32_t h) {
    return (std::floor(std::ldexp(static_cast<double>(h), -32) * 2 * half) - half) * unit;
  };
  return {offset(hash[0]), offset(hash[1])};
}

/// A ray displaced by `ray` pixels arrives at a pixel `step` away if the step is in its square.
bool arrives(double step, double ray) { return step - ray >= -0.5 && step - ray < 0.5; }

/// One lens cell's scatter over a frame.
class CellScatter {
 public:
  CellScatter(int width, int height, const LensCells& cells, std::size_t cell, std::uint32_t seed)
      : width_(width), height_(height), jitter_(cells.jitter), seed_(seed) {
    u_ = std::ldexp(static_cast<double>(cells.centres[cell][0]), -DEFRAY_LENS_FRACTION_BITS);
    v_ = std::ldexp(static_cast<double>(cells.centres[cell][1]), -DEFRAY_LENS_FRACTION_BITS);
    half_ = std::ldexp(static_cast<double>(cells.jitter), -DEFRAY_LENS_FRACTION_BITS);
  }

  /// Calls visit(target index) for each target pixel that source (px, py) of radius r reaches.
  template <typename Visit>
  void for_each_target(int px, int py, double r, const Visit& visit) const {
    const double spread = std::fabs(r) * half_ + 1;
    const int y0 = first(py + r * v_ - spread, height_), y1 = last(py + r * v_ + spread, height_);
    const int x0 = first(px + r * u_ - spread, width_), x1 = last(px + r * u_ + spread, width_);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        if (reaches(x, y, px, py, r)) visit(static_cast<std::size_t>(y) * width() + as_size(x));
      }
    }
  }

 private:
  static std::size_t as_size(int i) { return static_cast<std::size_t>(i); }
  std::size_t width() const { return as_size(width_); }
  static int first(double at, int size) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, static_cast<double>(size)));
  }
  static int last(double at, int size) {
    return static_cast<int>(std::clamp(std::ceil(at), -1.0, size - 1.0));
  }

  bool reaches(int x, int y, int px, int py, double r) const {
    Offset delta{0, 0};
    if (jitter_ != 0) delta = jitter_offset(x, y, seed_, jitter_);
    const double u = u_ + delta.u, v = v_ + delta.v;
    return u * u + v * v <= 1 && arrives(x - px, r * u) && arrives(y - py, r * v);
  }

  int width_, height_;
  std::int32_t jitter_;
  std::uint32_t seed_;
  double u_, v_, half_;
};

}  // namespace

std::vector<std::int64_t> rdb_scatter(int width, int height, const LensCells& cells,
                                      std::size_t cell, std::uint32_t seed,
                                      const std::vector<std::int32_t>& coc_quanta,
                                      const Plane& depth) {
  const CellScatter scatter(width, height, cells, cell, seed);
  std::vector<std::int64_t> winner(depth.size(), -1);
  std::size_t source = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++source) {
      const double r =
          std::ldexp(static_cast<double>(coc_quanta[source]), -DEFRAY_COC_FRACTION_BITS);
      scatter.for_each_target(x, y, r, [&](std::size_t target) {
        // Sources come in index order: an equal depth never replaces an earlier one.
        const std::int64_t held = winner[target];
        if (held < 0 || depth[source] < depth[static_cast<std::size_t>(held)]) {
          winner[target] = static_cast<std::int64_t>(source);
        }
      });
    }
  }
  return winner;
}

namespace {

/// Calls visit(target, source) for every ray that wins a cell, cell by cell in lens order.
template <typename Visit>
void for_each_winner(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                     const Plane& depth, const RdbSettings& settings, const Visit& visit,
                     const std::function<void(double)>& progress) {
  const LensCells cells = make_lens_cells(settings.cells_per_side, settings.jitter);
  const std::size_t count = cells.centres.size();
  for (std::size_t cell = 0; cell < count; ++cell) {
    const auto winner = rdb_scatter(width, height, cells, cell, settings.seed, coc_quanta, depth);
    for (std::size_t i = 0; i < winner.size(); ++i) {
      if (winner[i] >= 0) visit(i, static_cast<std::size_t>(winner[i]));
    }
    if (progress) progress(static_cast<double>(cell + 1) / static_cast<double>(count));
  }
}

}  // namespace

std::vector<Plane> render_rdb(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                              const Plane& depth, const std::vector<Plane>& channels,
                              const RdbSettings& settings,
                              const std::function<void(double)>& progress) {
  std::vector<Plane> sum(channels.size(), Plane(depth.size()));
  std::vector<std::vector<bool>> varies(channels.size(), std::vector<bool>(depth.size()));
  std::vector<std::size_t> first(depth.size()), filled(depth.size());
  const auto add = [&](std::size_t target, std::size_t source) {
    if (filled[target]++ == 0) first[target] = source;
    for (std::size_t c = 0; c < sum.size(); ++c) {
      sum[c][target] += channels[c][source];
      if (source != first[target] && channels[c][source] != channels[c][first[target]]) {
        varies[c][target] = true;
      }
    }
  };
  for_each_winner(width, height, coc_quanta, depth, settings, add, progress);
  std::vector<Plane> out(channels);  // a pixel that no ray reached keeps its own colour
  for (std::size_t c = 0; c < out.size(); ++c) {
    for (std::size_t i = 0; i < out[c].size(); ++i) {
      if (filled[i] == 0) continue;
      out[c][i] = varies[c][i] ? sum[c][i] / static_cast<float>(filled[i]) : channels[c][first[i]];
    }
  }
  return out;
}

std::vector<std::vector<double>> exact_rdb(int width, int height,
                                           const std::vector<std::int32_t>& coc_quanta,
                                           const Plane& depth, const std::vector<Plane>& channels,
                                           const RdbSettings& settings) {
  std::vector<std::vector<double>> mean(channels.size(), std::vector<double>(depth.size()));
  std::vector<int> filled(depth.size());
  const auto add = [&](std::size_t target, std::size_t source) {
    ++filled[target];
    for (std::size_t c = 0; c < mean.size(); ++c) {
      mean[c][target] += static_cast<double>(channels[c][source]);
    }
  };
  for_each_winner(width, height, coc_quanta, depth, settings, add, {});
  for (std::size_t c = 0; c < mean.size(); ++c) {
    for (std::size_t i = 0; i < filled.size(); ++i) {
      mean[c][i] = filled[i] == 0 ? static_cast<double>(channels[c][i]) : mean[c][i] / filled[i];
    }
  }
  return mean;
}

}  // namespace defray::reference
