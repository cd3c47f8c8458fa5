#include "bench.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/stopwatch.h"
#include "image/display.h"
#include "reference/twin_backend.h"

namespace defray::perf {
namespace {

std::vector<Plane> crop(const std::vector<Plane>& planes, int width, int x0, int y0, int w, int h) {
  std::vector<Plane> out(planes.size());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (int y = y0; y < y0 + h; ++y) {
      const auto row = planes[c].begin() + std::int64_t{y} * width + x0;
      out[c].insert(out[c].end(), row, row + w);
    }
  }
  return out;
}

}  // namespace

void check_against_twin(Backend& backend, const Subject& s, const MethodSettings& settings) {
  const int w = std::min(96, s.scene.width), h = std::min(64, s.scene.height);
  const int x0 = (s.scene.width - w) / 2, y0 = (s.scene.height - h) / 2;
  const auto colour = crop(s.pinhole.colour, s.scene.width, x0, y0, w, h);
  const Plane depth = crop({s.pinhole.depth}, s.scene.width, x0, y0, w, h)[0];
  reference::TwinBackend twin;
  const Frame frame{w, h, twin.coc(s.lens, s.scene.width, depth), depth, colour};
  if (apply_method(frame, settings, backend).colour != apply_method(frame, settings, twin).colour) {
    fail(ErrorKind::internal, "a timed picture differs from its twin");
  }
}

double seconds_of(const std::function<void()>& run) {
  const Stopwatch watch;
  run();
  return watch.seconds();
}

namespace {

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace

Timing time_of(int repetitions, const std::function<void()>& run,
               const std::function<void()>& after) {
  const auto timed = [&] {
    const double seconds = seconds_of(run);
    if (after) after();
    return seconds;
  };
  timed();
  constexpr double whole_s = 0.1, most_runs = 25;
  const double runs = repetitions > 3 ? std::clamp(whole_s / timed(), 1.0, most_runs) : 1;
  std::vector<double> medians;
  for (int i = 0; i < repetitions; ++i) {
    std::vector<double> seconds;
    for (int k = 0; k < static_cast<int>(runs); ++k) seconds.push_back(timed());
    medians.push_back(median_of(seconds));
  }
  const auto [least, largest] = std::minmax_element(medians.begin(), medians.end());
  const double median = median_of(medians);
  return {median, (*largest - *least) / median};
}

std::string to_text(const Timing& t) {
  return fmt::format("{:.3g} s ± {:.0f} %", t.median_s, 100 * t.spread);
}

std::string fixed(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

Timing time_method(const Bench& bench, const Subject& subject, const MethodSettings& settings) {
  check_against_twin(bench.backend, subject, settings);
  std::vector<Plane> first, picture;
  bool repeats = true;
  const Timing timing = time_of(
      bench.repetitions(), [&] { picture = render(bench.backend, subject, settings); },
      [&] {
        if (first.empty()) first = picture;
        repeats = repeats && picture == first;
        picture.clear();  // as a program has written it before the next
      });
  if (!repeats) fail(ErrorKind::internal, "a timed picture differs from run to run");
  return timing;
}

MethodSettings rdb_of(int cells_per_side) {
  MethodSettings s;
  s.rdb.cells_per_side = cells_per_side;
  return s;
}

MethodSettings linear_of() {
  MethodSettings s;
  s.method = Method::linear;
  return s;
}

MethodSettings gather_of(GatherKind kind, int samples, int passes) {
  MethodSettings s;
  s.method = Method::gather;
  s.gather.kind = kind;
  s.gather.samples = samples;
  s.gather.passes = passes;
  return s;
}

Figure sheet(const Bench& bench, const std::string& name, const std::string& caption,
             const std::vector<std::pair<std::string, const std::vector<Plane>*>>& pictures,
             int width, int height) {
  std::vector<SheetPanel> panels;
  for (const auto& [title, planes] : pictures) panels.push_back({title, *planes});
  write_sheet(bench.folder + "/" + name + ".png", panels, width, height);
  return {name + ".png", caption};
}

std::vector<std::array<double, 2>> accumulation_points(int n) {
  std::vector<std::array<double, 2>> points;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double u = (2.0 * i + 1) / n - 1, v = (2.0 * j + 1) / n - 1;
      const bool is_steep = std::fabs(v) > std::fabs(u);
      const double radius = is_steep ? v : u;
      const double quarter = std::numbers::pi / 4;
      const double angle = radius == 0 ? 0
                           : is_steep  ? 2 * quarter - quarter * u / v
                                       : quarter * v / u;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  return points;
}

}  // namespace defray::perf
