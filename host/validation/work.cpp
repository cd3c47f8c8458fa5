#include "validation/work.h"

#include <algorithm>
#include <cmath>

#include "kernels/params.h"
#include "validation/patterns_input.h"

namespace defray::validation {
namespace {

double squared(double x) { return x * x; }

/// What a launch a band adds: it costs some devices (Mesa's, which compiles for each launch anew)
/// milliseconds.
double band_work(const Case& c) {
  constexpr double launch_work = 4e4;
  return c.band_rows > 0 ? launch_work * std::ceil(c.height / double(c.band_rows)) : launch_work;
}

}  // namespace

double pixels(const Case& c) { return static_cast<double>(c.width) * c.height; }

double add_work(const Case& c) {
  const double maps = light_maps_work(c) - highlights_work(c);
  const double disc = std::min(squared(2 * c.coc_px + 5), pixels(c));
  return (4 * pixels(c) + band_work(c)) * c.cells * c.cells + pixels(c) / 6 * disc * 8 + maps;
}

double clear_work(const Case& c) { return pixels(c) * c.cells * c.cells; }

double agree_work(const Case& c) { return (3 + 3 * shift_count) * pixels(c) * 4 + band_work(c); }

double difference_work(const Case& c) { return shift_count * pixels(c) * 4; }

double mixed_work(const Case& c) { return 20 * pixels(c) + band_work(c); }

/// Steps of all ways over the picture: each grows by a 16th of the distance.
double fill_work(const Case& c) {
  const double across = std::max(c.width, c.height);
  const double steps = std::min(2 * c.coc_px, across) / 16;
  return pixels(c) * DEFRAY_FILL_DIRECTIONS * (2 + 16 * std::log1p(steps)) + band_work(c);
}

double feather_work(const Case& c) { return 100 * pixels(c) + fill_work(c); }

double gather_work(const Case& c) { return pixels(c) * c.samples * (4 + 2.0 * c.channels); }

double highlights_work(const Case& c) { return pixels(c) * 2 * 32 * 8 + band_work(c); }

/// A sixth of the pixels are lamps.
double light_maps_work(const Case& c) {
  const double entries = std::min(squared(2 * c.coc_px + 2), squared(DEFRAY_LIGHT_MAP));
  const double steps = std::min(2 * c.coc_px, std::max(c.width, c.height) / 2.0);
  return highlights_work(c) + pixels(c) / 6 * entries * (4 + steps);
}

double linear_work(const Case& c) {
  const double side = 2 * std::floor(c.coc_px + 0.5) + 1;
  return pixels(c) * squared(side) * (1 + c.channels);
}

double match_work(const Case& c) {
  return shift_count * pixels(c) * (8 + 0.25 * squared(window_of(c))) + band_work(c);
}

double rdb_work(const Case& c) {
  const double side = c.jitter ? 2 * (c.coc_px / c.cells + 1) + 1 : 1;
  const double rays = pixels(c) * c.cells * c.cells;
  return 4 * rays * (1 + std::min(squared(side), pixels(c))) + band_work(c) * c.cells * c.cells;
}

double ray_tiles_work(const Case& c) {
  return 64 * pixels(c) + squared(pixels(c) / 256 + 1) * DEFRAY_RAY_BINS;
}

double repair_work(const Case& c) { return 100 * pixels(c) + band_work(c); }

double soften_work(const Case& c) { return 300 * pixels(c) + band_work(c); }

/// A quarter as many splats as pixels, each as large as its blur or a few pixels.
double splat_work(const Case& c) {
  return pixels(c) / 4 * std::min(squared(2 * c.coc_px + 8), pixels(c)) * 20 + band_work(c);
}

double split_work(const Case& c) { return 200 * pixels(c) + 2 * fill_work(c); }

double tiles_work(const Case& c) { return pixels(c) + squared(pixels(c) / 256 + 1); }

}  // namespace defray::validation
