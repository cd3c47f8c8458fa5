#include "validation/rdb_winners.h"

#include "device/rdb_scatter.h"
#include "reference/reference.h"

namespace defray::validation {
namespace {

constexpr std::uint32_t unclear = 7;
constexpr std::size_t words_beyond = 512;

std::size_t words(int width, int height, int cells) {
  return 2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
         static_cast<std::size_t>(cells * cells);
}

std::int64_t index_in_frame(const RdbWinner& w, std::int64_t window, const Frame& frame,
                            const RayPlan& plan) {
  if (w.source == DEFRAY_EMPTY) return w.key == DEFRAY_EMPTY ? -1 : -2;
  const std::int64_t index = window + w.source;
  if (index >= static_cast<std::int64_t>(frame.surfaces())) return -2;
  const auto source = static_cast<std::size_t>(index);
  const std::int64_t radius = std::int64_t{w.key} - (std::int64_t{1} << 31);
  const std::int32_t own = frame.coc_quanta[source];
  const reference::Span span =
      plan.lens.jitter == 0 ? reference::span_of(frame, plan, source) : reference::Span{own, own};
  return radius >= span.least && radius <= span.largest ? index : -2;
}

}  // namespace

std::vector<std::int64_t> winners_on_device(Session& session, const Frame& frame,
                                            const RayPlan& plan) {
  RdbScatter run(session, frame, plan);
  const std::size_t pixels = frame.pixels();
  std::vector<std::int64_t> all(plan.lens.points.size() * pixels, -2);
  for (const RdbPass& pass : run.passes()) {
    run.scatter(pass);
    const std::vector<RdbWinner> winners = run.winners(pass);
    const std::size_t band = winners.size() / size(pass.cell_count);
    const auto window = static_cast<std::int64_t>(run.first_source(pass));
    const std::size_t first = size(pass.y) * size(frame.width);
    for (std::size_t i = 0; i < winners.size(); ++i) {
      const std::size_t cell = i / band + size(pass.first_cell);
      all[cell * pixels + first + i % band] = index_in_frame(winners[i], window, frame, plan);
    }
  }
  return all;
}

std::vector<std::int64_t> winners_of_twin(const Frame& frame, const RayPlan& plan) {
  std::vector<std::int64_t> all;
  for (std::size_t cell = 0; cell < plan.lens.points.size(); ++cell) {
    const auto winners = reference::rdb_scatter(frame, plan, cell);
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
  session.launch("rdb_clear", {count}, p, buffer);
  session.read(buffer, content.data(), bytes);
  return content;
}

std::vector<std::uint32_t> cleared_twin(int width, int height, int cells) {
  std::vector<std::uint32_t> content(words(width, height, cells), DEFRAY_EMPTY);
  content.resize(content.size() + words_beyond, unclear);
  return content;
}

}  // namespace defray::validation
