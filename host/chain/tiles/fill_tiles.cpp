#include "chain/tiles/fill_tiles.h"

#include <algorithm>

#include "chain/tiles/tiles.h"
#include "lens/coc.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

struct FillTile {
  std::int32_t nearest = DEFRAY_TAME_QUANTA, farthest = -DEFRAY_TAME_QUANTA;
  bool has_mixed = false;

  void add(const FillTile& other) {
    nearest = std::min(nearest, other.nearest);
    farthest = std::max(farthest, other.farthest);
    has_mixed |= other.has_mixed;
  }
};

/// How many cells away the next one is in which a pixel is marked, along either axis; 0: it is this
/// one. Of cells in `known` rows. Two sweeps, each over the four neighbours that it has passed.
class CellDistances {
 public:
  CellDistances(const Frame& f, const Words& marks, Rows known)
      : across_(cells(f.width)),
        first_(known.y / DEFRAY_FILL_CELL),
        end_(cells(known.end)),
        away_(size(across_) * size(cells(f.height)), far) {
    const auto is_marked = marks.host();
    parallel_for(end_ - first_, [&](int row) {
      const int j = first_ + row, end = std::min(known.end, (j + 1) * DEFRAY_FILL_CELL);
      for (int y = std::max(known.y, j * DEFRAY_FILL_CELL); y < end; ++y) {
        for (int x = 0; x < f.width; ++x) {
          if (is_marked[f.index(x, y)]) at(x / DEFRAY_FILL_CELL, j) = 0;
        }
      }
    });
    for (int j = first_; j < end_; ++j) {
      for (int i = 0; i < across_; ++i) pass_on(i, j, 1);
    }
    for (int j = end_ - 1; j >= first_; --j) {
      for (int i = across_ - 1; i >= 0; --i) pass_on(i, j, -1);
    }
  }

  /// So many pixels around those of a run that begins in a cell none is marked, at least: of all
  /// cells, 0 where rows are not known.
  Values<std::uint8_t> pure_around_runs() const {
    std::vector<std::uint8_t> pure(away_.size());
    parallel_for(end_ - first_, [&](int row) {
      for (int i = 0; i < across_; ++i) {
        const std::size_t cell = size(first_ + row) * size(across_) + size(i);
        const auto from = away_.begin() + static_cast<std::ptrdiff_t>(cell);
        const int least = *std::min_element(from, from + std::min(cells_of_run, across_ - i));
        pure[cell] = static_cast<std::uint8_t>(std::max(least - 1, 0) * DEFRAY_FILL_CELL);
      }
    });
    return pure;
  }

 private:
  /// Farther does not matter: so many pixels fit into a byte.
  static constexpr std::uint8_t far = 255 / DEFRAY_FILL_CELL;
  static constexpr int cells_of_run = DEFRAY_RUN / DEFRAY_FILL_CELL + 1;

  static int cells(int px) { return (px + DEFRAY_FILL_CELL - 1) / DEFRAY_FILL_CELL; }
  std::uint8_t& at(int i, int j) { return away_[size(j) * size(across_) + size(i)]; }

  void pass_on(int i, int j, int back) {
    std::uint8_t& own = at(i, j);
    const auto look = [&](int x, int y) {
      if (x < 0 || x >= across_ || y < first_ || y >= end_) return;
      own = static_cast<std::uint8_t>(std::min<int>(own, at(x, y) + 1));
    };
    look(i - back, j);
    for (int x = i - 1; x <= i + 1; ++x) look(x, j - back);
  }

  int across_, first_, end_;
  std::vector<std::uint8_t> away_;
};

}  // namespace

int fill_reach(std::int32_t farthest, std::int32_t own) {
  return (farthest - own) / (1 << DEFRAY_COC_FRACTION_BITS) + 2;
}

int fill_rows(const CocRange& range) {
  // What is found is looked at further on.
  return fill_reach(tame(range.largest), tame(range.least)) + launch_of("fill").reach_px;
}

Quanta farthest_to_fill(const Frame& f, const Words& marks) {
  const auto coc_quanta = f.coc_quanta.host();
  const auto marked = marks.host();
  const auto look = [&](FillTile& tile, int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const std::size_t i = f.index(x, y);
        const std::int32_t coc = tame(coc_quanta[i]);
        tile.add({coc, coc, (marked[i] & DEFRAY_MIXED) != 0});
      }
    }
  };
  constexpr int side = DEFRAY_FILL_TILE;
  const CocRange range = f.coc_range();
  const Rows wanted = f.wanted_rows();
  const Rows known = wanted.with(fill_rows(range), f.height);
  const Tiles<FillTile> tiles(f.width, f.height, known, side, look);
  const FillTile all = tiles.all();
  std::vector<std::int32_t> farthest(tiles.count(), DEFRAY_NOTHING_BEHIND);
  for (std::size_t t = tiles.first_of(wanted, side); t < tiles.end_of(wanted, side); ++t) {
    // A mixed pixel looks from the nearest surface around it, which may be the next tile's.
    const std::int32_t nearest = tiles.around(t, 1).nearest;
    FillTile met = all;
    // The less far there is to meet, the less far a pixel looks.
    for (int i = 0; i < 2; ++i) met = tiles.around(t, fill_reach(met.farthest, nearest) / side + 1);
    if (met.has_mixed) farthest[t] = met.farthest;
  }
  return farthest;
}

Values<std::uint8_t> pure_around_runs(const Frame& f, const Words& marks) {
  const Rows known = f.wanted_rows().with(fill_rows(f.coc_range()), f.height);
  return CellDistances(f, marks, known).pure_around_runs();
}

}  // namespace defray
