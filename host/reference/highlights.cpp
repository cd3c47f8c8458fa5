// Twins of kernels/chain/highlights.cl.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lens/aperture_table.h"
#include "lens/cats_eye.h"
#include "lens/coc.h"
#include "reference/reference.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

float light_of(const Frame& f, std::size_t at, int light_channels) {
  float most = f.channels[0][at];
  for (int c = 1; c < light_channels; ++c) {
    most = std::fmax(most, f.channels[static_cast<std::size_t>(c)][at]);
  }
  return most;
}

/// Light of the front fragments at 32 points around a disc, those within the frame and seen.
std::vector<float> light_around(const Frame& f, int x, int y, float radius, int light_channels) {
  std::vector<float> light;
  for (int i = 0; i < 32; ++i) {
    const double angle = i % 16 * std::numbers::pi / 8;
    const float distance = std::fmax(radius, 3.0f) * (i < 16 ? 0.5f : 1.0f) + 2.0f;
    const auto rounded = [&](double direction) {
      return static_cast<int>(std::rint(distance * static_cast<float>(direction)));
    };
    const int qx = x + rounded(std::cos(angle)), qy = y + rounded(std::sin(angle));
    if (qx < 0 || qy < 0 || qx >= f.width || qy >= f.height) continue;
    const std::size_t front = f.index(qx, qy, 0);
    if (f.coverage[front] >= DEFRAY_SYNTHESISED) continue;
    light.push_back(light_of(f, front, light_channels));
  }
  return light;
}

/// The share of its light that a highlight before such surroundings keeps.
float kept_of(float own, float median) {
  constexpr float range = DEFRAY_HIGHLIGHT_WHOLE - DEFRAY_HIGHLIGHT;
  const float of_whole = median / own;
  if (median * DEFRAY_HIGHLIGHT_WHOLE <= own) return of_whole;
  return 1 - (own - DEFRAY_HIGHLIGHT * median) / (range * median) * (1 - of_whole);
}

constexpr std::int32_t lens_radius = 1 << DEFRAY_LENS_FRACTION_BITS;

/// Lens coordinates, limited to the square around the lens.
struct Box {
  std::int32_t left = -lens_radius, top = -lens_radius;
  std::int32_t right = lens_radius, bottom = lens_radius;
};

/// The part of the lens that a source's light passes on its way to the pixel at this distance.
Box box_between(int dx, int dy, std::int32_t coc) {
  const auto border = [&](int i) {
    const std::int64_t lens = (2 * std::int64_t{i} + 1) * (1 << 23) / coc;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(lens, -lens_radius, lens_radius));
  };
  const auto [u0, u1] = std::minmax({border(dx - 1), border(dx)});
  const auto [v0, v1] = std::minmax({border(dy - 1), border(dy)});
  return {u0, v0, u1, v1};
}

/// The light within a box that passes the lens's rim, by strips as long as their middle's chord.
std::uint64_t light_through(const ApertureTable& table, const Box& box, const RimCentre& rim) {
  const std::int64_t top = std::max(box.top, rim[1] - lens_radius);
  const std::int64_t high =
      std::max<std::int64_t>(std::min(box.bottom, rim[1] + lens_radius) - top, 0);
  const std::int64_t strips = 16 + high * 32 / lens_radius;
  std::uint64_t light = 0;
  for (std::int64_t k = 0; k < strips; ++k) {
    const std::int64_t above = top + high * k / strips, below = top + high * (k + 1) / strips;
    const double away = static_cast<double>((above + below) / 2 - rim[1]);
    const double square = static_cast<double>(lens_radius) * lens_radius - away * away;
    const auto reach = static_cast<std::int32_t>(std::sqrt(std::fmax(square, 0.0)));
    light +=
        light_in_box(table, std::max(box.left, rim[0] - reach), static_cast<std::int32_t>(above),
                     std::min(box.right, rim[0] + reach), static_cast<std::int32_t>(below));
  }
  return light;
}

/// Distances in eighths of a pixel.
std::uint32_t cell_between(const LightSources& lights, int dx, int dy, std::int32_t coc) {
  const auto entry = [&](int d) {
    const std::int64_t lens = std::int64_t{d} * (1 << 21) / coc;
    constexpr std::int64_t radius = 1 << DEFRAY_LENS_FRACTION_BITS;
    const auto at = static_cast<std::int64_t>(std::floor(
        static_cast<double>(lens + radius) * DEFRAY_CELL_MAP / static_cast<double>(2 * radius)));
    return static_cast<std::size_t>(std::clamp<std::int64_t>(at, 0, DEFRAY_CELL_MAP - 1));
  };
  return lights.cell_map[entry(dy) * DEFRAY_CELL_MAP + entry(dx)];
}

/// Share of the pixel that a sharp edge in front of a source with this CoC covers; 0: no such edge.
float sharp_edge(const Frame& f, std::size_t front, std::int32_t coc) {
  if (f.coverage.empty() || f.coverage[front] >= DEFRAY_WHOLE) return 0;
  const std::int32_t own = tame(f.coc_quanta[front]);
  if (std::abs(own) >= DEFRAY_SHARP_QUANTA || own >= coc - DEFRAY_JUMP_QUANTA) return 0;
  return static_cast<float>(f.coverage[front]) * (1.0f / DEFRAY_WHOLE);
}

RimCentre rim_at(const RayPlan& plan, int x, int y) {
  return {plan.rim_x[static_cast<std::size_t>(x)], plan.rim_y[static_cast<std::size_t>(y)]};
}

}  // namespace

Values<float> TwinBackend::highlights(const Frame& f, int light_channels, Values<float>) {
  Plane kept(f.depth.size(), 1.0f);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(f.width));
    const int y = static_cast<int>(i / static_cast<std::size_t>(f.width * f.layers));
    const float own = light_of(f, i, light_channels);
    const std::int32_t coc = tame(f.coc_quanta[i]);
    if (f.coverage[i] == 0 || f.coverage[i] >= DEFRAY_SYNTHESISED || coc == 0) continue;
    if (!(own > 0) || std::isinf(own)) continue;
    const float radius = std::fabs(static_cast<float>(coc)) * px_per_quantum;
    std::vector<float> light = light_around(f, x, y, radius, light_channels);
    const auto dim = std::count_if(light.begin(), light.end(),
                                   [&](float v) { return v * DEFRAY_HIGHLIGHT < own; });
    if (static_cast<std::size_t>(dim) <= light.size() / 2) continue;
    // NaNs are no surroundings: the kernel's ranks leave the median to the first that has it.
    float median = 1;
    bool is_found = false;
    for (std::size_t k = 0; k < light.size(); ++k) {
      std::size_t rank = 0;
      for (std::size_t j = 0; j < light.size(); ++j) {
        rank += light[j] < light[k] || (light[j] == light[k] && j < k);
      }
      if (rank == light.size() / 2) {
        median = light[k];
        is_found = true;
      }
    }
    if (is_found) kept[i] = kept_of(own, std::fmax(median, 0.0f));
  }
  return kept;
}

void highlights_add(const LightSources& lights, const Frame& f, const RayPlan& plan,
                    const std::vector<std::vector<std::int32_t>>& winner,
                    std::vector<Plane>& means) {
  const ApertureTable table{lights.table};
  const bool has_rim = !plan.rim_x.empty();
  std::vector<Plane> added(means.size(), Plane(means[0].size()));
  for (std::size_t s = 0; s < lights.where.size(); ++s) {
    const int sx = lights.where[s][0], sy = lights.where[s][1], coc = lights.where[s][2];
    const int reach = static_cast<int>(std::min(std::abs(coc) / 256 + 2, f.width + f.height));
    for (int y = std::max(0, sy - reach); y <= std::min(f.height - 1, sy + reach); ++y) {
      for (int x = std::max(0, sx - reach); x <= std::min(f.width - 1, sx + reach); ++x) {
        const int across = std::abs(coc) < DEFRAY_WIDE_QUANTA ? 4 : 1;
        const Box box = box_between(x - sx, y - sy, coc);
        const std::uint64_t arrives =
            has_rim ? light_through(table, box, rim_at(plan, x, y))
                    : light_in_box(table, box.left, box.top, box.right, box.bottom);
        if (arrives == 0) continue;
        const auto own =
            static_cast<std::size_t>(y * f.layers) * static_cast<std::size_t>(f.width) +
            static_cast<std::size_t>(x);
        const float covered = sharp_edge(f, own, coc);
        const auto target = static_cast<std::size_t>(y) * static_cast<std::size_t>(f.width) +
                            static_cast<std::size_t>(x);
        const auto is_hidden = [&](int dx, int dy) {
          const std::int32_t held = winner[cell_between(lights, dx, dy, coc)][target];
          const auto at = static_cast<std::size_t>(held);
          if (covered > 0 && at == own) return false;
          return held >= 0 && tame(f.coc_quanta[at]) < coc - DEFRAY_JUMP_QUANTA;
        };
        int visible = 0;
        for (int j = 0; j < across; ++j) {
          for (int i = 0; i < across; ++i) {
            const int du = across == 4 ? 2 * i - 3 : 0, dv = across == 4 ? 2 * j - 3 : 0;
            visible += !is_hidden(8 * (x - sx) + du, 8 * (y - sy) + dv);
          }
        }
        if (visible == 0) continue;
        const float seen =
            static_cast<float>(visible) / static_cast<float>(across * across) * (1 - covered);
        const float share = static_cast<float>(arrives) * lights.share_of_light * seen;
        for (std::size_t c = 0; c < means.size(); ++c) {
          added[c][target] += share * lights.excess[s][c];
        }
      }
    }
  }
  Plane open(has_rim ? means[0].size() : 0);  // what the rim leaves counts as all light
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto width = static_cast<std::size_t>(f.width);
    const RimCentre rim = rim_at(plan, static_cast<int>(i % width), static_cast<int>(i / width));
    const std::uint64_t passes = light_through(table, {}, rim);
    open[i] = std::fmax(static_cast<float>(passes) * lights.share_of_light, 1e-6f);
  }
  for (std::size_t c = 0; c < means.size(); ++c) {
    for (std::size_t i = 0; i < means[c].size(); ++i) {
      if (has_rim) added[c][i] /= open[i];
      means[c][i] += added[c][i];
    }
  }
}

}  // namespace defray::reference
