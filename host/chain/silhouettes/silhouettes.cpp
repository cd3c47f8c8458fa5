#include "chain/silhouettes/silhouettes.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/parallel.h"
#include "chain/silhouettes/ends.h"
#include "chain/silhouettes/strips.h"

namespace defray {
namespace {

/// How far a silhouette is marked where it is seen: no way along a row of mixed pixels passes its
/// end.
constexpr int seen_px = DEFRAY_FILL_MIXED + 1;

/// Rows from its end that one is drawn to, by one of a strip's two.
constexpr int drawn_rows = longest_px + std::max(seen_px, thin_px) + strip_pair_px + 1;

class Marks {
 public:
  /// Of the wanted rows.
  Marks(const Frame& f, std::span<std::uint32_t> marks)
      : f_(f), coc_(f), rows_(f.wanted_rows()), marks_(marks) {}

  /// Marks the pixels that a silhouette goes through, until it comes out from what hides it. Each
  /// lies beside the next along an axis: no way passes between two.
  void draw(const SilhouetteEnd& end) const {
    for (const int i : {0, 1, 2, 3}) mark_hidden(end, {end.at.x - i % 2, end.at.y - i / 2});
    constexpr double step = 0.125;
    double hidden_px = 0;  // as far as it was
    Corner last = end.pixel(-seen_px, 0);
    for (double px = -seen_px; px <= std::min(end.px, hidden_px + 2); px += step) {
      const Corner pixel = end.pixel(px, 0), between{last.x, pixel.y};
      if (px > 0) {
        mark_hidden(end, between);
        if (mark_hidden(end, pixel)) hidden_px = px;
      } else {
        mark(between);
        mark(pixel);
      }
      last = pixel;
    }
  }

 private:
  /// Returns whether something in front of the surface hides it there.
  bool mark_hidden(const SilhouetteEnd& end, Corner pixel) const {
    const bool is_hidden = is_jump(coc_(pixel), end.coc);
    if (is_hidden) mark(pixel);
    return is_hidden;
  }

  void mark(Corner p) const {
    if (p.x < 0 || p.x >= f_.width || p.y < rows_.y || p.y >= rows_.end) return;
    const std::atomic_ref pixel(marks_[f_.index(p.x, p.y)]);
    pixel.fetch_or(DEFRAY_SILHOUETTE, std::memory_order_relaxed);
  }

  const Frame& f_;
  CocAround coc_;
  Rows rows_;
  std::span<std::uint32_t> marks_;
};

}  // namespace

int silhouette_rows() { return drawn_rows + silhouette_end_rows(); }

void continue_silhouettes(const Frame& front, const Words& mixed, Silhouettes& into) {
  const Rows wanted = front.wanted_rows();
  for (Words* words : {&into.marks, &into.strips}) {
    if (words->empty()) *words = Words(front.pixels());
  }
  const auto is_mixed = mixed.host();
  const auto marks = into.marks.edit(), strips = into.strips.edit();
  const std::size_t first = front.index(0, wanted.y);
  const auto rows = is_mixed.subspan(first, front.index(0, wanted.end) - first);
  std::copy(rows.begin(), rows.end(), marks.subspan(first).begin());
  std::fill_n(strips.subspan(first).begin(), rows.size(), 0);
  const std::vector<SilhouetteEnd> ends =
      silhouette_ends(front, mixed, wanted.with(drawn_rows, front.height));
  const Marks drawn(front, marks);
  parallel_for(static_cast<int>(ends.size()), [&](int i) {
    if (!ends[size(i)].is_thin()) drawn.draw(ends[size(i)]);
  });
  mark_thin(front, mixed, marks);
  continue_strips(front, ends, strips);
}

}  // namespace defray
