#include "chain/steps/behind.h"

#include <algorithm>
#include <utility>

#include "chain/silhouettes/strips.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

/// Rows of strips below each other, so far apart that none matches another: their frame and its
/// pixels, which come a strip at a time.
class StripFrame {
 public:
  StripFrame(const Frame& front, std::size_t strips, int rows, int apart)
      : frame(front.without_planes()), rows_(rows), apart_(apart) {
    frame.margin = 0;
    frame.height = static_cast<int>(strips) * (rows + apart) - apart;
    frame.coc_quanta = Quanta(frame.pixels());
    frame.inverse = Values<float>(frame.pixels());
    pixels = Words(frame.pixels());
  }

  void add(const Frame& front, const Words& front_pixels, Rows strip) {
    const std::size_t count = size(strip.count()) * size(frame.width);
    const std::size_t from = front.index(0, strip.y), to = frame.index(0, next_);
    const auto copy = [&](const auto& plane, auto& into) {
      const auto rows = plane.host().subspan(from, count);
      std::copy(rows.begin(), rows.end(), into.edit().subspan(to).begin());
    };
    copy(front.coc_quanta, frame.coc_quanta);
    copy(front.inverse, frame.inverse);
    copy(front_pixels, pixels);
    next_ += rows_ + apart_;
  }

  Frame frame;
  Words pixels;

 private:
  int rows_, apart_, next_ = 0;
};

int feather_reach() { return launch_of("feather").reach_px; }

}  // namespace

std::vector<Rows> pattern_strips(int width, int height, const PatternSettings& s) {
  if (size(width) * size(height) <= s.most_searched || height <= s.strips * s.strip_rows) {
    return {{0, height}};
  }
  std::vector<Rows> strips;
  for (int k = 0; k < s.strips; ++k) {
    const int first = height / s.strips * k + (height / s.strips - s.strip_rows) / 2;
    strips.push_back({first, first + s.strip_rows});
  }
  return strips;
}

Behind::Behind(Front& front, ChainWork& work, const PatternSettings& settings)
    : front_(front), work_(work), settings_(settings) {
  settings_.shifts = work.settings.pattern_shifts;
}

void Behind::look_at_all() {
  if (!has_patterns()) return;
  const int margin = front_.frame.margin;
  const std::vector<Rows> strips =
      pattern_strips(front_.frame.width - 2 * margin, front_.frame.height - 2 * margin, settings_);
  if (strips.size() > 1) return look_at_strips(strips);
  fill_to(front_.frame.height);
  front_.frame.wanted.reset();
  shifts_ = find_shifts(work_.backend, front_.frame, pixels_, settings_);
  work_.done("patterns");
}

void Behind::look_at_strips(const std::vector<Rows>& strips) {
  StripFrame all(front_.frame, strips.size(), settings_.strip_rows, work_.reach.patterns);
  for (const Rows& strip : strips) {
    const Rows rows{strip.y + front_.frame.margin, strip.end + front_.frame.margin};
    if (work_.is_banded) restart(rows.y);
    fill_to(rows.end);
    all.add(front_.frame, pixels_, rows);
    work_.done("patterns");
  }
  shifts_ = find_shifts(work_.backend, all.frame, all.pixels, settings_);
  if (work_.is_banded) restart(0);
  work_.done("patterns");
}

void Behind::restart(int y) {
  give_back_to(front_.frame.height);
  const auto before = [](int row, int reach) {
    return std::max(0, row - reach) / band_step * band_step;
  };
  fill_done_ = before(y, 0);
  patterns_done_ = done_ = kept_ = kept_made_ = kept_pixels_ = fill_done_;
  silhouettes_done_ = kept_silhouettes_ = before(fill_done_, work_.reach.fill);
  front_.restart(before(silhouettes_done_, work_.reach.silhouettes));
}

void Behind::silhouettes_to(int end) {
  const Rows rows = go_on(silhouettes_done_, end, front_.frame.height);
  if (rows.empty()) return;
  front_.to(rows.end + work_.reach.silhouettes);
  front_.frame.wanted = rows;
  continue_silhouettes(front_.frame, front_.mixed, silhouettes_);
  work_.done("silhouettes");
}

void Behind::fill_to(int end) {
  const Rows rows = go_on(fill_done_, end, front_.frame.height);
  if (rows.empty()) return;
  silhouettes_to(rows.end + work_.reach.fill);
  front_.frame.wanted = rows;
  // Where patterns add their detail twice as many directions are worth their time; without them
  // the mean of fewer is as close to the truth (perf/notes/behind.md).
  const int directions = has_patterns() ? DEFRAY_FILL_DIRECTIONS : 8;
  made_ = work_.backend.fill(front_.frame, silhouettes_.marks, directions, std::move(made_));
  paint_strips(front_.frame, silhouettes_.strips, made_);
  work_.done("fill");
  if (!has_patterns()) return;
  pixels_ = patterns_pixels(front_.frame, made_, front_.mixed, std::move(pixels_));
  work_.done("patterns");
}

void Behind::patterns_to(int end) {
  const Rows rows = go_on(patterns_done_, end, front_.frame.height);
  if (rows.empty()) return;
  fill_to(rows.end + work_.reach.patterns);
  if (!has_patterns()) return;
  front_.frame.wanted = rows;
  improve_by_patterns(work_.backend, front_.frame, pixels_, shifts_, settings_, made_);
  work_.done("patterns");
}

void Behind::to(int end) {
  const Rows rows = go_on(done_, end, front_.frame.height);
  if (rows.empty()) return;
  patterns_to(rows.end + feather_reach());
  made_.wanted = rows;
  feathered_ = work_.backend.feather(made_, front_.frame.coc_quanta, silhouettes_.marks,
                                     silhouettes_.strips, std::move(feathered_));
  work_.done("feather");
}

Frame Behind::frame() const {
  Frame f = made_;
  f.channels = feathered_;
  return f;
}

int Behind::front_needed() const {
  const int height = front_.frame.height;
  // Strips are painted from rows as far away as silhouettes look.
  const int around_fill = std::max(work_.reach.fill, work_.reach.silhouettes);
  const int by_fill = fill_done_ < height ? fill_done_ - around_fill : height;
  const bool has_matches = patterns_done_ < height && has_patterns();
  const int by_patterns = has_matches ? patterns_done_ - work_.reach.patterns : height;
  const int by_feather = done_ < height ? done_ - feather_reach() : height;
  return std::min({by_fill, by_patterns, by_feather});
}

void Behind::give_back_to(int end) {
  const Frame& f = front_.frame;
  give_back(f, not_needed(kept_, end), feathered_);
  const int feather = end - feather_reach();
  const Rows made = not_needed(kept_made_, feather);
  give_back(f, made, made_.coc_quanta);
  give_back(f, made, made_.inverse);
  give_back(f, made, made_.channels);
  const Rows marked =
      not_needed(kept_silhouettes_, std::min(fill_done_ - work_.reach.fill, feather));
  give_back(f, marked, silhouettes_.marks);
  give_back(f, marked, silhouettes_.strips);
  give_back(f, not_needed(kept_pixels_, end - work_.reach.patterns), pixels_);
}

}  // namespace defray
