// Where the time goes: each kernel of a default render beside what the machine's memory and
// arithmetic allow, measured in the same run.
#include <algorithm>
#include <map>

#include "base/error.h"
#include "chain/ray_plan.h"
#include "experiments.h"
#include "limits.h"
#include "measure/plot.h"
#include "opencl/session.h"
#include "truth.h"

namespace defray::perf {
namespace {

struct Use {
  std::vector<double> seconds;  ///< Of each run.
  std::size_t bytes = 0;
  double median_s() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// What each kernel takes of a default render; every run must give the same picture.
std::map<std::string, Use> uses_of(const Bench& bench, const Subject& subject) {
  SessionOptions options;
  options.measures = true;
  Session session(bench.backend.session().info(), options);
  DeviceBackend backend(session);
  std::map<std::string, Use> uses;
  const std::vector<Plane> expected = render(bench.backend, subject, default_chain());
  for (int i = 0; i <= bench.repetitions(); ++i) {
    if (render(backend, subject, default_chain()) != expected) {
      fail(ErrorKind::internal, "{}: two runs gave two pictures", subject.scene.name);
    }
    const auto taken = session.take_kernel_seconds();
    if (i == 0) continue;  // to warm up
    for (const auto& [kernel, seconds] : taken) uses[kernel].seconds.push_back(seconds);
  }
  for (auto& [kernel, use] : uses) use.bytes = session.kernel_bytes().at(kernel);
  return uses;
}

struct RooflinePlace {
  std::string scene, setting;
};

/// The points, and the line on which a kernel is as fast as the memory.
void add_plot(const Bench& bench, const RooflinePlace& place, Series series, Section& section) {
  const auto by_x = [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; };
  const auto [least, most] = std::minmax_element(series.points.begin(), series.points.end(), by_x);
  const Series line{"the memory's speed", {{least->x, least->x}, {most->x, most->x}}, true, false};
  const Plot plot{series.name + ": kernels beside the memory's speed",
                  "ms that its buffers take at the memory's speed",
                  "ms that it takes",
                  true,
                  true,
                  {series, line}};
  const std::string file = "roofline-" + place.scene + ".png";
  write_plot(bench.folder + "/" + file, plot);
  section.figures.push_back({file, plot.title});
}

void add_place(const Bench& bench, const RooflinePlace& place, const Limits& limits,
               Section& section) {
  const std::string name = place.scene + " " + place.setting;
  bench.step(name);
  const int width = bench.size(1920), height = bench.size(1080);
  const Subject subject =
      make_subject(bench.backend, make_scene(place.scene, width, height), place.setting);
  Table table{"roofline-" + place.scene,
              fmt::format("{}, {} x {}, default", name, width, height),
              {"kernel", "time, ms", "buffers, MB", "of them by the memory's speed, ms",
               "time in units of that"},
              {}};
  Series series{name, {}, false, true};
  double all_ms = 0, memory_ms = 0;
  const std::size_t points = ray_plan(*default_chain().chain, false).lens.points.size();
  for (const auto& [kernel, use] : uses_of(bench, subject)) {
    const double took_ms = 1e3 * use.median_s();
    const double least_ms = 1e3 * static_cast<double>(use.bytes) / limits.bytes_a_second;
    table.rows.push_back({kernel, fixed(took_ms), fixed(1e-6 * static_cast<double>(use.bytes), 1),
                          fixed(least_ms), fixed(took_ms / least_ms, 1)});
    series.points.push_back({least_ms, took_ms, kernel});
    all_ms += took_ms;
    memory_ms += least_ms;
    if (kernel != "rdb_gather") continue;
    const double rays = static_cast<double>(subject.frame().pixels() * points);
    section.findings.push_back(fmt::format(
        "{}: {:.2f} G rays a second end in `rdb_gather`, {:.0f} % of the {:.1f} G tests a second "
        "that vectors in registers do.",
        name, 1e-9 * rays / use.median_s(), 100 * rays / use.median_s() / limits.tests_a_second,
        1e-9 * limits.tests_a_second));
  }
  section.findings.push_back(
      fmt::format("{}: kernels take {:.0f} ms; to read and write each of their buffers once takes "
                  "{:.0f} ms at {:.1f} GB/s.",
                  name, all_ms, memory_ms, 1e-9 * limits.bytes_a_second));
  add_plot(bench, place, std::move(series), section);
  section.tables.push_back(std::move(table));
}

}  // namespace

Section roofline(const Bench& bench) {
  Section section{"Where the time goes",
                  "Each kernel's time on the device (events, medians) beside the time in which the "
                  "memory could read or write every buffer it is given once: on the line a kernel "
                  "is as fast as the memory; as far above it as it computes, or waits for what it "
                  "reads here and there.",
                  {},
                  {},
                  {}};
  bench.step("the machine's limits");
  const Limits limits = measure_limits(bench.backend.session().info(), bench.repetitions());
  Plot plot{"Kernels beside the memory's speed",
            "ms that its buffers take at the memory's speed",
            "ms that it takes",
            true,
            true,
            {}};
  for (const RooflinePlace& place :
       {RooflinePlace{"fence", "bg"}, RooflinePlace{"spheres", "f2"}}) {
    add_place(bench, place, limits, section);
  }
  return section;
}

}  // namespace defray::perf
