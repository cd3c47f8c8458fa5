#include "chain/silhouettes/strips.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "base/parallel.h"

namespace defray {
namespace {

/// Between two places on a strip: each pixel of it has one.
constexpr double step_px = 0.5;

/// Where a strip's own pixels are looked for: so far before its end the first of its surface.
constexpr double first_own_px = 3, last_own_px = 6;

/// A line across pixels, and how many of them a thin surface takes on it.
struct Cut {
  Corner step;
  int most;
};
constexpr std::array<Cut, 4> cuts{
    {{{1, 0}, thin_px}, {{0, 1}, thin_px}, {{1, 1}, thin_px * 2 / 3}, {{-1, 1}, thin_px * 2 / 3}}};

Corner stepped(Corner pixel, Corner step, int steps) {
  return {pixel.x + steps * step.x, pixel.y + steps * step.y};
}

/// How many pixels of one surface follow each other from a pixel on, between farther ones; 0 where
/// there are more than `cut.most`, or they end otherwise.
int thin_from(const CocAround& coc, Corner pixel, const Cut& cut) {
  std::int32_t own = coc(pixel);
  if (!is_jump(own, coc(stepped(pixel, cut.step, -1)))) return 0;
  for (int count = 1; count <= cut.most; ++count) {
    const std::int32_t next = coc(stepped(pixel, cut.step, count));
    if (is_jump(own, next)) return count;
    if (!is_same(own, next)) return 0;
    own = next;
  }
  return 0;
}

class Strips {
 public:
  Strips(const Frame& f, std::span<std::uint32_t> strips)
      : f_(f), coc_(f), rows_(f.wanted_rows()), strips_(strips) {}

  /// As far as it is hidden where it comes out again, or else as the lens looks.
  void draw(const SilhouetteEnd& end) const {
    const double hidden_px = hidden(end);
    const double px = comes_out(end, hidden_px) ? hidden_px : std::min(end.px, hidden_px);
    const std::vector<std::uint32_t> own = own_pixels(end);
    for (double along = -2; along <= px; along += step_px) {
      for (std::size_t i = 0; i < own.size(); ++i) {
        const Corner pixel = end.pixel(along, across(i));
        const bool is_drawn = own[i] > 0 && is_wanted(pixel) && is_on(end, pixel);
        if (is_drawn && is_jump(coc_(pixel), end.coc)) strips_[f_.index(pixel.x, pixel.y)] = own[i];
      }
    }
  }

 private:
  static double across(std::size_t i) { return (static_cast<double>(i) + 0.5) * step_px; }

  /// How far something in front hides any of it.
  double hidden(const SilhouetteEnd& end) const {
    double px = 0;
    for (double along = 0; along <= std::min<double>(longest_px, px + 2); along += step_px) {
      for (double in = step_px / 2; in < end.wide_px; in += step_px) {
        if (is_jump(coc_(end.pixel(along, in)), end.coc)) px = along;
      }
    }
    return px;
  }

  /// Whether its surface is seen again there.
  bool comes_out(const SilhouetteEnd& end, double hidden_px) const {
    constexpr double around = 2;
    for (double along = 0; along <= around; along += step_px) {
      for (double in = -around; in <= end.wide_px + around; in += step_px) {
        if (is_same(coc_(end.pixel(hidden_px + along, in)), end.coc)) return true;
      }
    }
    return false;
  }

  /// 1 + the index of a pixel of the strip for each step across it; 0: none there.
  std::vector<std::uint32_t> own_pixels(const SilhouetteEnd& end) const {
    std::vector<std::uint32_t> own;
    for (std::size_t i = 0; across(i) < end.wide_px; ++i) {
      own.push_back(0);
      for (double back = first_own_px; own[i] == 0 && back <= last_own_px; back += step_px) {
        const Corner pixel = end.pixel(-back, across(i));
        const bool is_own = is_inside(pixel) && is_same(coc_(pixel), end.coc);
        if (is_own) own[i] = static_cast<std::uint32_t>(1 + f_.index(pixel.x, pixel.y));
      }
    }
    return own;
  }

  /// Whether a pixel's centre lies on the strip.
  static bool is_on(const SilhouetteEnd& end, Corner p) {
    const double in = (p.x + 0.5 - end.x) * end.inwards_x + (p.y + 0.5 - end.y) * end.inwards_y;
    return in >= 0 && in < end.wide_px;
  }

  bool is_inside(Corner p) const {
    return p.x >= 0 && p.x < f_.width && p.y >= 0 && p.y < f_.height;
  }
  bool is_wanted(Corner p) const { return is_inside(p) && p.y >= rows_.y && p.y < rows_.end; }

  const Frame& f_;
  CocAround coc_;
  Rows rows_;
  std::span<std::uint32_t> strips_;
};

/// Whether two ends are those of one strip's two edges.
bool are_of_one(const SilhouetteEnd& a, const SilhouetteEnd& b) {
  const double along = a.along_x * b.along_x + a.along_y * b.along_y;
  if (!is_same(a.coc, b.coc) || along < 0.9) return false;
  const double x = b.x - a.x + b.wide_px / 2 * b.inwards_x - a.wide_px / 2 * a.inwards_x;
  const double y = b.y - a.y + b.wide_px / 2 * b.inwards_y - a.wide_px / 2 * a.inwards_y;
  return std::abs(x * a.inwards_x + y * a.inwards_y) < 1.5 &&
         std::abs(x * a.along_x + y * a.along_y) < strip_pair_px;
}

/// The thin ones, the first of each pair. From the top, as they are given.
std::vector<SilhouetteEnd> ends_of_strips(std::vector<SilhouetteEnd> ends) {
  std::erase_if(ends, [](const SilhouetteEnd& end) { return !end.is_thin(); });
  std::vector<SilhouetteEnd> first_ones;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    bool is_first = true;
    for (std::size_t j = i; is_first && j > 0; --j) {
      if (ends[i].at.y - ends[j - 1].at.y > strip_pair_px) break;
      is_first = !are_of_one(ends[j - 1], ends[i]);
    }
    if (is_first) first_ones.push_back(ends[i]);
  }
  return first_ones;
}

}  // namespace

void mark_thin(const Frame& f, const Words& mixed, std::span<std::uint32_t> marks) {
  const CocAround coc(f);
  const auto is_mixed = mixed.host();
  const Rows wanted = f.wanted_rows(), rows = wanted.with(thin_px, f.height);
  const auto mark = [&](Corner p) {
    if (p.x < 0 || p.x >= f.width || p.y < wanted.y || p.y >= wanted.end) return;
    const std::atomic_ref pixel(marks[f.index(p.x, p.y)]);
    pixel.fetch_or(DEFRAY_MIXED, std::memory_order_relaxed);
  };
  parallel_for(rows.count(), [&](int row) {
    for (int x = 0; x < f.width; ++x) {
      const Corner first{x, rows.y + row};
      if (!is_mixed[f.index(first.x, first.y)]) continue;  // no jump is near
      for (const Cut& cut : cuts) {
        const int count = thin_from(coc, first, cut);
        for (int i = 0; i < count; ++i) mark(stepped(first, cut.step, i));
      }
    }
  });
}

void continue_strips(const Frame& front, const std::vector<SilhouetteEnd>& all_ends,
                     std::span<std::uint32_t> strips) {
  std::vector<SilhouetteEnd> ends = ends_of_strips(all_ends);
  // The nearer ones over the farther ones.
  std::stable_sort(ends.begin(), ends.end(), [](auto& a, auto& b) { return a.coc > b.coc; });
  const Strips all(front, strips);
  for (const SilhouetteEnd& end : ends) all.draw(end);
}

void paint_strips(const Frame& front, const Words& strips, Frame& behind) {
  const Rows rows = front.wanted_rows();
  const auto from = strips.host();
  const std::size_t first = front.index(0, rows.y), end = front.index(0, rows.end);
  const auto is_strip = [&](std::size_t i) { return from[first + i] > 0; };
  if (!parallel_any(end - first, is_strip)) return;  // planes stay on their device
  const auto paint = [&](const auto& plane, auto& into) {
    const auto source = plane.host();
    const auto painted = into.edit();
    parallel_for_each(end - first, [&](std::size_t i) {
      if (is_strip(i)) painted[first + i] = source[from[first + i] - 1];
    });
  };
  paint(front.coc_quanta, behind.coc_quanta);
  paint(front.inverse, behind.inverse);
  for (std::size_t c = 0; c < front.channels.size(); ++c) {
    paint(front.channels[c], behind.channels[c]);
  }
}

}  // namespace defray
