#include "validation/rdb_winners.h"

#include <bit>

#include "reference/reference.h"

namespace defray::validation {
namespace {

constexpr std::uint32_t unclear = 7;
constexpr std::size_t words_beyond = 512;

std::size_t words(int width, int height, int cells) {
  return 2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
         static_cast<std::size_t>(cells * cells);
}

std::int64_t index_in_frame(const RdbWinner& w, std::int64_t window, const Plane& depth) {
  if (w.source == DEFRAY_EMPTY) return w.depth_bits == DEFRAY_EMPTY ? -1 : -2;
  const std::int64_t index = window + w.source;
  const bool is_there = index < static_cast<std::int64_t>(depth.size());
  const bool is_its_own = is_there && std::bit_cast<std::uint32_t>(
                                          depth[static_cast<std::size_t>(index)]) == w.depth_bits;
  return is_its_own ? index : -2;
}

}  // namespace

std::vector<std::int64_t> winners_on_device(Session& session, const FragmentView& fragments,
                                            const RdbSettings& settings) {
  RdbRun run(session, fragments, settings);
  const std::size_t pixels = fragments.depth.size() / static_cast<std::size_t>(fragments.layers);
  std::vector<std::int64_t> all(lens_cells(settings).centres.size() * pixels, -2);
  for (const RdbPass& pass : run.passes()) {
    run.scatter(pass);
    const std::vector<RdbWinner> winners = run.winners(pass);
    const std::size_t band = winners.size() / static_cast<std::size_t>(pass.cell_count);
    const std::int64_t window = std::int64_t{pass.window_y} * fragments.layers * fragments.width;
    const auto first = static_cast<std::size_t>(std::int64_t{pass.band_y} * fragments.width);
    for (std::size_t i = 0; i < winners.size(); ++i) {
      const std::size_t cell = i / band + static_cast<std::size_t>(pass.first_cell);
      all[cell * pixels + first + i % band] = index_in_frame(winners[i], window, fragments.depth);
    }
  }
  return all;
}

std::vector<std::int64_t> winners_of_twin(const FragmentView& fragments,
                                          const RdbSettings& settings) {
  const LensCells cells = lens_cells(settings);
  std::vector<std::int64_t> all;
  for (std::size_t cell = 0; cell < cells.centres.size(); ++cell) {
    const auto winners = reference::rdb_scatter(fragments, settings, cells, cell);
    all.insert(all.end(), winners.begin(), winners.end());
  }
  return all;
}

std::vector<std::uint32_t> cleared_on_device(Session& session, int width, int height, int cells) {
  std::vector<std::uint32_t> content(words(width, height, cells) + words_beyond, unclear);
  const std::size_t bytes = content.size() * sizeof(content[0]);
  const cl::Buffer buffer = session.buffer(bytes);
  session.write(buffer, content.data(), bytes);
  DefrayRdbParams p{};
  p.width = static_cast<std::uint32_t>(width);
  p.band_rows = static_cast<std::uint32_t>(height);
  p.cell_count = static_cast<std::uint32_t>(cells * cells);
  const std::size_t count = (content.size() - words_beyond) / 2;
  session.launch("rdb_clear", DEFRAY_RDB_CLEAR_GROUP, {count}, p, buffer);
  session.read(buffer, content.data(), bytes);
  return content;
}

std::vector<std::uint32_t> cleared_twin(int width, int height, int cells) {
  std::vector<std::uint32_t> content(words(width, height, cells), DEFRAY_EMPTY);
  content.resize(content.size() + words_beyond, unclear);
  return content;
}

}  // namespace defray::validation
