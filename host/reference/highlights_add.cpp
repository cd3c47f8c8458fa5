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

/// Share of the pixel that something in focus in front of a source with this CoC covers.
float covered_in_focus(const Frame& f, std::size_t front, std::int32_t coc) {
  const std::int32_t own = tame(f.coc_quanta[front]);
  if (std::abs(own) >= DEFRAY_SHARP_QUANTA || own >= coc - DEFRAY_JUMP_QUANTA) return 0;
  if (f.coverage.empty()) return 1;
  return static_cast<float>(f.coverage[front] & ~DEFRAY_SYNTHESISED) * (1.0f / DEFRAY_WHOLE);
}

/// Of a map of the lens the value between its entries, at a pixel's place.
class SeenMap {
 public:
  SeenMap(const std::uint8_t* map, int side, std::int32_t coc)
      : map_(map), side_(side), coc_(coc) {}

  /// So far from the middle of a source, px.
  float at(float dx, float dy) const {
    if (side_ == 0) return 1;  // no map: nothing hides it
    const auto [column, right] = place(dx);
    const auto [row, below] = place(dy);
    const std::uint8_t* const upper = map_ + row * side_ + column;
    const float top = between(upper, right), bottom = between(upper + side_, right);
    return (top + below * (bottom - top)) * (1.0f / 255.0f);
  }

 private:
  static float between(const std::uint8_t* two, float share) {
    const auto first = static_cast<float>(two[0]);
    return first + share * (static_cast<float>(two[1]) - first);
  }

  /// The entry before, and how far beyond it.
  std::pair<int, float> place(float distance) const {
    const float lens = distance / (static_cast<float>(coc_) * px_per_quantum);
    const auto side = static_cast<float>(side_);
    const float at = std::clamp((lens + 1) * (0.5f * side) - 0.5f, 0.0f, side - 1);
    const int before = std::min(static_cast<int>(at), side_ - 2);
    return {before, at - static_cast<float>(before)};
  }

  const std::uint8_t* map_;
  int side_;
  std::int32_t coc_;
};

RimCentre rim_at(const RayPlan& plan, int x, int y) {
  return {plan.rim_x[static_cast<std::size_t>(x)], plan.rim_y[static_cast<std::size_t>(y)]};
}

}  // namespace

void highlights_add(const LightSources& lights, const Frame& f, const RayPlan& plan,
                    std::vector<Plane>& means) {
  const ApertureTable table{lights.table};
  const std::vector<std::uint8_t> maps = light_maps(lights, f);
  const bool has_rim = !plan.rim_x.empty();
  std::vector<Plane> added(means.size(), Plane(means[0].size()));
  for (std::size_t s = 0; s < lights.where.size(); ++s) {
    const int sx = lights.where[s][0], sy = lights.where[s][1], coc = lights.where[s][2];
    const int across = lights.where[s][3] % DEFRAY_LIGHT_ROW;
    const int down = lights.where[s][3] / DEFRAY_LIGHT_ROW;
    const SeenMap map(maps.data() + lights.maps[s][0], lights.maps[s][1], coc);
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
        const auto target = static_cast<std::size_t>(y) * static_cast<std::size_t>(f.width) +
                            static_cast<std::size_t>(x);
        const float visible =
            map.at(static_cast<float>(x - sx) - 0.5f * static_cast<float>(across - 1),
                   static_cast<float>(y - sy) - 0.5f * static_cast<float>(down - 1));
        if (visible == 0) continue;
        const float seen = visible * (1 - covered_in_focus(f, own, coc));
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
