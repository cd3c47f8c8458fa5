#include "chain/steps/layered.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "chain/steps/border.h"
#include "chain/steps/highlights.h"
#include "chain/steps/layers.h"
#include "lens/aperture.h"
#include "lens/aperture_table.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

int split_reach() { return launch_of("split").reach_px; }

}  // namespace

Layered::Layered(Front& front, Behind& behind, ChainWork& work)
    : front_(front), behind_(behind), work_(work), rows_range_(size(front.frame.height)) {}

int Layered::light_channels() const {
  return static_cast<int>(front_.frame.channels.size()) - (has_alpha() ? 1 : 0);
}

void Layered::split(Rows rows) {
  Frame& f = front_.frame;
  if (!has_two()) {
    f.wanted = rows;
    return make_whole(f);
  }
  // Without `split` no pixel counts as mixed: all keep their colour and surface.
  if (!work_.settings.split) {
    if (none_mixed_.empty()) none_mixed_ = Words::room(f.pixels());
    const auto mixed = none_mixed_.edit();
    std::fill(mixed.begin() + static_cast<std::ptrdiff_t>(f.index(0, rows.y)),
              mixed.begin() + static_cast<std::ptrdiff_t>(f.index(0, rows.end)), 0u);
  }
  f.wanted = rows;
  layers_ = work_.backend.split(f, work_.settings.split ? front_.mixed : none_mixed_,
                                behind_.frame(), std::move(layers_));
  layers_.wanted = rows;
  describe_layers(f, layers_, work_.report);
}

/// For the report, and for those who come after.
void Layered::describe(Rows rows) {
  front_.frame.wanted = rows;
  work_.tiles.add_surfaces(front_.frame, front_.mixed);
  if (has_two()) work_.tiles.add_hidden(behind_.frame().inverse, rows);
  const Frame& f = frame();
  const auto coc = f.coc_quanta.host();
  parallel_for(rows.count(), [&](int i) {
    const std::size_t first = f.index(0, rows.y + i), end = f.index(0, rows.y + i + 1);
    const auto [least, largest] = std::ranges::minmax(coc.subspan(first, end - first));
    rows_range_[size(rows.y + i)] = {least, largest};
  });
  work_.done("tiles");
}

void Layered::split_to(int end) {
  const Rows rows = go_on(split_done_, end, height());
  if (rows.empty()) return;
  if (has_two()) behind_.to(rows.end);
  front_.to(rows.end + split_reach());
  split(rows);
  work_.done("split");
  describe(rows);
}

void Layered::highlights_to(int end) {
  const Rows rows = go_on(highlights_done_, end, height());
  if (rows.empty()) return;
  split_to(rows.end + work_.reach.highlights);
  Frame& f = frame();
  f.wanted = rows;
  f.known_range = work_.reach.all;
  kept_ = work_.backend.highlights(f, light_channels(), std::move(kept_));
  if (has_alpha()) {
    if (alpha_.empty()) alpha_ = Values<float>::room(f.surfaces());
    const auto from = f.channels.back().host();
    const auto at = static_cast<std::ptrdiff_t>(f.index(0, rows.y));
    std::copy(from.begin() + at, from.begin() + static_cast<std::ptrdiff_t>(f.index(0, rows.end)),
              alpha_.edit().begin() + at);
  }
  work_.done("highlights");
}

void Layered::lights_to(int end) {
  const Rows rows = go_on(lights_done_, end, height());
  if (rows.empty()) return;
  if (!work_.settings.highlights) return split_to(rows.end);
  highlights_to(rows.end + work_.reach.highlights);
  Frame& f = frame();
  f.wanted = rows;
  const auto kept =
      kept_.host().subspan(f.index(0, rows.y), f.index(0, rows.end) - f.index(0, rows.y));
  if (parallel_any(kept.size(), [&](std::size_t i) { return kept[i] != 1.0f; })) {
    if (lights_.empty()) {
      show_through(make_aperture_table(rasterise(work_.settings.aperture)), lights_);
    }
    take_light(f, kept_, alpha_, light_channels(), lights_);
  }
  work_.done("highlights");
}

/// The margins above and below come with the rows that they continue.
void Layered::margin_to(int end) {
  const int first = rows_to_continue(front_.frame), last = height() - front_.frame.margin;
  const Rows rows = go_on(margin_done_, end > last ? height() : std::max(end, first), height());
  if (rows.empty()) return;
  lights_to(rows.end);
  if (work_.settings.border != Border::clamp) return;
  frame().wanted = rows;
  continue_colours(frame());
  work_.done("border");
}

void Layered::to(int end) {
  if (!work_.settings.soften) return margin_to(end);
  const Rows rows = go_on(soften_done_, end, height());
  if (rows.empty()) return;
  margin_to(rows.end + work_.reach.soften);
  Frame& f = frame();
  f.wanted = rows;
  f.known_range = work_.reach.all;
  softened_ = work_.backend.soften(f, work_.report.lens_points, std::move(softened_));
  work_.done("soften");
}

Frame Layered::frame_for_rays(Rows rows) const {
  Frame f = frame();
  if (work_.settings.soften) f.channels = softened_;
  f.wanted = rows;
  const Rows near = rows.with(work_.reach.rays, height());
  CocRange range = rows_range_[size(near.y)];
  for (int y = near.y; y < near.end; ++y) range.add(rows_range_[size(y)]);
  f.known_range = range;
  return f;
}

LightSources Layered::lights_for_rays(const Frame& f) const {
  return lights_near(lights_, f, work_.reach.rays);
}

void Layered::give_back_to(int end) {
  const int rays = end - work_.reach.rays - band_step;  // windows begin with whole tiles
  const bool is_margin_left = margin_done_ < height();  // the margin below looks back
  const int margin = is_margin_left ? height() - rows_to_continue(front_.frame) - 1 : height();
  const int soften = work_.settings.soften ? soften_done_ - work_.reach.soften - 1 : rays;
  const int rows = std::min(rays, margin), colours = std::min(soften, margin);
  const int front =
      std::min(split_done_ - split_reach(), has_two() ? behind_.front_needed() : rows);
  front_.give_back_to(std::min(front - band_step, has_two() ? height() : colours));
  behind_.give_back_to(split_done_);
  if (has_two()) {
    const Rows sent = not_needed(kept_rows_, rows);
    give_back(layers_, sent, layers_.coc_quanta);
    give_back(layers_, sent, layers_.depth);
    give_back(layers_, sent, layers_.coverage);
    give_back(layers_, sent, layers_.data_of);
    give_back(layers_, not_needed(kept_colours_, colours), layers_.channels);
  }
  const Rows shares = not_needed(kept_shares_, lights_done_ - work_.reach.highlights - 1);
  give_back(frame(), shares, kept_);
  give_back(frame(), shares, alpha_);
  give_back(frame(), not_needed(kept_softened_, rays), softened_);
}

}  // namespace defray
