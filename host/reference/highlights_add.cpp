// Twin of kernels/chain/highlights_add.cl.
#include <algorithm>
#include <cmath>

#include "lens/aperture_table.h"
#include "lens/cats_eye.h"
#include "lens/coc.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

constexpr std::int32_t lens_radius = 1 << DEFRAY_LENS_FRACTION_BITS;

/// Lens coordinates, limited to the square around the lens.
struct Box {
  std::int32_t left = -lens_radius, top = -lens_radius;
  std::int32_t right = lens_radius, bottom = lens_radius;
};

/// The part of the lens that a source's light passes on its way to the pixel at this distance.
Box box_between(int dx, int dy, int across, int down, std::int32_t coc) {
  const auto border = [&](int i) {
    const std::int64_t lens = (2 * std::int64_t{i} + 1) * (1 << 23) / coc;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(lens, -lens_radius, lens_radius));
  };
  const auto [u0, u1] = std::minmax({border(dx - across), border(dx)});
  const auto [v0, v1] = std::minmax({border(dy - down), border(dy)});
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

/// How much of a source is seen from a pixel: of a small disc at 16 places in it, of a wide one
/// from cells around the nearest, weighed 1 2 1 along both axes. Places in eighths of a
/// pixel.
template <typename IsSeen>
int visible_of_16(std::int32_t coc, std::int64_t spread, const IsSeen& is_seen) {
  int visible = 0;
  if (std::abs(coc) < DEFRAY_WIDE_QUANTA) {
    for (int i = 0; i < 16; ++i) visible += is_seen(2 * (i % 4) - 3, 2 * (i / 4) - 3);
    return visible;
  }
  const auto step = static_cast<int>(std::abs(std::int64_t{coc}) * spread / (1 << 21));
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      if (is_seen(step * du, step * dv)) visible += (2 - std::abs(du)) * (2 - std::abs(dv));
    }
  }
  return visible;
}

RimCentre rim_at(const RayPlan& plan, int x, int y) {
  return {plan.rim_x[static_cast<std::size_t>(x)], plan.rim_y[static_cast<std::size_t>(y)]};
}

}  // namespace

void highlights_add(const LightSources& lights, const Frame& f, const RayPlan& plan,
                    const std::vector<std::vector<std::int32_t>>& winner,
                    std::vector<Plane>& means) {
  const ApertureTable table{lights.table};
  const bool has_rim = !plan.rim_x.empty();
  std::vector<Plane> added(means.size(), Plane(means[0].size()));
  for (std::size_t s = 0; s < lights.where.size(); ++s) {
    const int sx = lights.where[s][0], sy = lights.where[s][1], coc = lights.where[s][2];
    const int across = lights.where[s][3] % DEFRAY_LIGHT_ROW;
    const int down = lights.where[s][3] / DEFRAY_LIGHT_ROW;
    const int reach = static_cast<int>(std::min(std::abs(coc) / 256 + 2, f.width + f.height));
    for (int y = std::max(0, sy - reach); y < std::min(f.height, sy + down + reach); ++y) {
      for (int x = std::max(0, sx - reach); x < std::min(f.width, sx + across + reach); ++x) {
        const Box box = box_between(x - sx, y - sy, across, down, coc);
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
        const int visible = visible_of_16(coc, lights.spread, [&](int du, int dv) {
          return !is_hidden(8 * (x - sx) - 4 * (across - 1) + du,
                            8 * (y - sy) - 4 * (down - 1) + dv);
        });
        if (visible == 0) continue;
        const float seen = static_cast<float>(visible) / 16 * (1 - covered);
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
