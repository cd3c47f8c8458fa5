#include "chain/silhouettes/silhouettes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/parallel.h"
#include "chain/tiles/fill_tiles.h"
#include "lens/coc.h"

namespace defray {
namespace {

// None matters much: over `cutout`, `plate1`, `plate2` and `spheres`, 640x480, no PSNR changes by
// more than 0.04 dB for 12 to 24 traced steps, 3 to 10 least ones, 4 to 7 px wide, 24 to 96 long.
/// Steps from pixel to pixel along an edge that tell its direction, and least.
constexpr int most_traced = 16, least_traced = 6;
/// Narrower surfaces do not go on: their two edges would not agree (`lines`: -0.16 dB).
constexpr int least_wide_px = 4;
/// How far a silhouette goes on, where the lens looks so far.
constexpr int longest_px = 64;
/// How far it is marked where it is seen: no way along a row of mixed pixels passes its end.
constexpr int seen_px = DEFRAY_FILL_MIXED + 1;

/// A corner of pixels: (x, y) is the upper left one of pixel (x, y).
struct Corner {
  int x, y;
};

/// The ways along edges of pixels: up, right, down, left.
constexpr std::array<Corner, 4> ways{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

/// On which hand the nearer of two surfaces lies, for one who walks along the edge between them.
enum class Hand { left, right };

/// Two pixels beside a way along their edge.
struct Sides {
  std::int32_t nearer, farther;
};

/// Where a silhouette ends at what hides it, and how it goes on.
struct End {
  Corner at;
  std::int32_t coc;         ///< Of the surface whose silhouette it is.
  double along_x, along_y;  ///< Unit vector.
  double px;                ///< As far as it goes on.
};

bool is_jump(std::int32_t near, std::int32_t far) { return far - near > DEFRAY_JUMP_QUANTA; }
bool is_same(std::int32_t a, std::int32_t b) { return std::abs(a - b) <= DEFRAY_JUMP_QUANTA; }
int floor_of(double px) { return static_cast<int>(std::floor(px)); }

/// The direction in which corners spread the most (half the angle of their second moments), towards
/// the first: of whole numbers by roots, the same on any machine.
std::array<double, 2> direction_of(const std::vector<Corner>& corners) {
  std::int64_t x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const Corner& c : corners) {
    const std::int64_t dx = c.x - corners.front().x, dy = c.y - corners.front().y;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  const auto n = static_cast<std::int64_t>(corners.size());
  const auto wider = static_cast<double>((n * xx - x * x) - (n * yy - y * y));
  const auto slant = static_cast<double>(2 * (n * xy - x * y));
  const double root = std::sqrt(wider * wider + slant * slant);
  const double ux = wider >= 0 ? wider + root : slant, uy = wider >= 0 ? slant : root - wider;
  const double away = ux * static_cast<double>(x) + uy * static_cast<double>(y);
  const double length = std::copysign(std::sqrt(ux * ux + uy * uy), -away);
  return {ux / length, uy / length};
}

class Silhouettes {
 public:
  /// Marks pixels of `rows`.
  Silhouettes(const Frame& f, Rows rows, std::span<std::uint32_t> marks)
      : f_(f), coc_quanta_(f.coc_quanta.host()), rows_(rows), marks_(marks) {}

  /// Those that end at a corner: of three surfaces the nearest hides the edge between the others.
  void go_on_from(Corner at) const {
    std::array<std::int32_t, 4> sorted = around(at);
    std::sort(sorted.begin(), sorted.end());
    int jumps = 0;
    std::int32_t middle = 0;  // of three surfaces
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_jump(sorted[i], sorted[i + 1]) && ++jumps == 1) middle = sorted[i + 1];
    }
    if (jumps != 2) return;
    const double px = std::min(longest_px, fill_reach(middle, sorted[0]));
    for (std::size_t way = 0; way < 4; ++way) {
      for (const Hand hand : {Hand::left, Hand::right}) {
        const std::vector<Corner> corners = trace(at, middle, way, hand);
        if (corners.size() <= least_traced) continue;
        const auto [x, y] = direction_of(corners);
        const End end{at, middle, x, y, px};
        const bool is_loop = !std::isfinite(x);  // has no direction
        if (!is_loop && is_wide(end, hand)) draw(end);
      }
    }
  }

 private:
  std::int32_t coc(int x, int y) const { return tame(coc_quanta_[f_.index_within(x, y)]); }

  /// The pixels around a corner, clockwise from the upper left one: way i goes between i and i + 1.
  std::array<std::int32_t, 4> around(Corner c) const {
    return {coc(c.x - 1, c.y - 1), coc(c.x, c.y - 1), coc(c.x, c.y), coc(c.x - 1, c.y)};
  }

  Sides sides(Corner c, std::size_t way, Hand hand) const {
    const std::array<std::int32_t, 4> all = around(c);
    const std::int32_t left = all[way], right = all[(way + 1) % 4];
    return hand == Hand::left ? Sides{left, right} : Sides{right, left};
  }

  /// The corners along the edge of a surface in front of any farther one, as far as it is looked
  /// at.
  std::vector<Corner> trace(Corner at, std::int32_t surface, std::size_t way, Hand hand) const {
    std::vector<Corner> corners{at};
    const auto is_edge = [&](std::size_t next) {
      const auto [nearer, farther] = sides(at, next, hand);
      if (!is_same(nearer, surface) || !is_jump(surface, farther)) return false;
      surface = nearer;
      way = next;
      return true;
    };
    // Towards the surface, straight on, away from it.
    const std::size_t towards = hand == Hand::left ? 3 : 1;
    bool goes_on = is_edge(way);
    while (goes_on && corners.size() <= most_traced) {
      at = {at.x + ways[way].x, at.y + ways[way].y};
      corners.push_back(at);
      const std::size_t own = way;
      goes_on = at.x > 0 && at.y > 0 && at.x < f_.width && at.y < f_.height &&
                (is_edge((own + towards) % 4) || is_edge(own) || is_edge((own + 4 - towards) % 4));
    }
    return corners;
  }

  /// Whether no farther surface shows on the own side of the edge.
  bool is_wide(const End& end, Hand hand) const {
    const double inwards_x = hand == Hand::left ? -end.along_y : end.along_y;
    const double inwards_y = hand == Hand::left ? end.along_x : -end.along_x;
    for (const double back : {2.0, 5.0, 8.0}) {
      for (double in = 1.5; in < least_wide_px; ++in) {
        const double x = end.at.x - back * end.along_x + in * inwards_x;
        const double y = end.at.y - back * end.along_y + in * inwards_y;
        if (is_jump(end.coc, coc(floor_of(x), floor_of(y)))) return false;
      }
    }
    return true;
  }

  /// Marks the pixels that a silhouette goes through, until it comes out from what hides it. Each
  /// lies beside the next along an axis: no way passes between two.
  void draw(const End& end) const {
    for (const int i : {0, 1, 2, 3}) mark_hidden(end, end.at.x - i % 2, end.at.y - i / 2);
    constexpr double step = 0.125;
    double hidden_px = 0;  // as far as it was
    int last_x = floor_of(end.at.x - seen_px * end.along_x);
    for (double px = -seen_px; px <= std::min(end.px, hidden_px + 2); px += step) {
      const int x = floor_of(end.at.x + px * end.along_x);
      const int y = floor_of(end.at.y + px * end.along_y);
      if (px > 0) {
        mark_hidden(end, last_x, y);
        if (mark_hidden(end, x, y)) hidden_px = px;
      } else {
        mark(last_x, y);
        mark(x, y);
      }
      last_x = x;
    }
  }

  /// Returns whether something in front of the surface hides it there.
  bool mark_hidden(const End& end, int x, int y) const {
    const bool is_hidden = is_jump(coc(x, y), end.coc);
    if (is_hidden) mark(x, y);
    return is_hidden;
  }

  void mark(int x, int y) const {
    if (x < 0 || x >= f_.width || y < rows_.y || y >= rows_.end) return;
    const std::atomic_ref pixel(marks_[f_.index(x, y)]);
    pixel.fetch_or(DEFRAY_SILHOUETTE, std::memory_order_relaxed);
  }

  const Frame& f_;
  std::span<const std::int32_t> coc_quanta_;
  Rows rows_;
  std::span<std::uint32_t> marks_;
};

/// Rows from its end that one is drawn to.
constexpr int drawn_rows = longest_px + seen_px + 1;

}  // namespace

int silhouette_rows() { return drawn_rows + most_traced + least_wide_px + 2; }

Words continue_silhouettes(const Frame& front, const Words& mixed, Words into) {
  const Rows wanted = front.wanted_rows(), ends = wanted.with(drawn_rows, front.height);
  if (into.empty()) into = Words(front.pixels());
  const auto is_mixed = mixed.host();
  const auto marks = into.edit();
  const std::size_t first = front.index(0, wanted.y);
  const auto rows = is_mixed.subspan(first, front.index(0, wanted.end) - first);
  std::copy(rows.begin(), rows.end(), marks.subspan(first).begin());
  const Silhouettes silhouettes(front, wanted, marks);
  parallel_for(ends.count(), [&](int row) {
    const int y = ends.y + row;
    for (int x = 1; y > 0 && x < front.width; ++x) {
      if (is_mixed[front.index(x, y)]) silhouettes.go_on_from({x, y});
    }
  });
  return into;
}

}  // namespace defray
