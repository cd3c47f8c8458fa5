// Where the time goes: each kernel of a default render beside what the machine's memory and
// arithmetic allow, measured in the same run.
#include <algorithm>
#include <map>

#include "base/error.h"
#include "chain/plan/ray_plan.h"
#include "experiments.h"
#include "machine/limits.h"
#include "measure/plot.h"
#include "opencl/session.h"
#include "splats/splat_shots.h"
#include "truth/truth.h"

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

/// Kernels of one picture, in the order of their names.
using Uses = std::map<std::string, Use>;

/// What is drawn, on any backend.
using Draw = std::function<std::vector<Plane>(Backend&)>;

/// What each kernel takes of it; every run must give the same picture.
Uses uses_of(const Bench& bench, const std::string& name, const Draw& draw) {
  SessionOptions options;
  options.measures = true;
  Session session(bench.backend.session().info(), options);
  DeviceBackend backend(session);
  Uses uses;
  const std::vector<Plane> expected = draw(bench.backend);
  for (int i = 0; i <= bench.repetitions(); ++i) {
    if (draw(backend) != expected) {
      fail(ErrorKind::internal, "{}: two runs gave two pictures", name);
    }
    const auto taken = session.take_kernel_seconds();
    if (i == 0) continue;  // to warm up
    for (const auto& [kernel, seconds] : taken) uses[kernel].seconds.push_back(seconds);
  }
  for (auto& [kernel, use] : uses) use.bytes = session.kernel_bytes().at(kernel);
  return uses;
}

/// The points, and the line on which a kernel is as fast as the memory.
void add_plot(const Bench& bench, const std::string& name, Series series, Section& section) {
  const auto by_x = [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; };
  const auto [least, most] = std::minmax_element(series.points.begin(), series.points.end(), by_x);
  const Series line{"the memory's speed", {{least->x, least->x}, {most->x, most->x}}, true, false};
  const Plot plot{series.name + ": kernels beside the memory's speed",
                  "ms that its buffers take at the memory's speed",
                  "ms that it takes",
                  true,
                  true,
                  {series, line}};
  const std::string file = "roofline-" + name + ".png";
  write_plot(bench.folder + "/" + file, plot);
  section.figures.push_back({file, plot.title});
}

/// `file` is what its files are called, `what` its picture.
void add_uses(const Bench& bench, const std::string& file, const std::string& what,
              const Uses& uses, const Limits& limits, Section& section) {
  Table table{"roofline-" + file,
              what,
              {"kernel", "time, ms", "buffers, MB", "of them by the memory's speed, ms",
               "time in units of that"},
              {}};
  Series series{what, {}, false, true};
  double all_ms = 0, memory_ms = 0;
  for (const auto& [kernel, use] : uses) {
    const double took_ms = 1e3 * use.median_s();
    const double least_ms = 1e3 * static_cast<double>(use.bytes) / limits.bytes_a_second;
    table.rows.push_back({kernel, fixed(took_ms), fixed(1e-6 * static_cast<double>(use.bytes), 1),
                          fixed(least_ms), fixed(took_ms / least_ms, 1)});
    series.points.push_back({least_ms, took_ms, kernel});
    all_ms += took_ms;
    memory_ms += least_ms;
  }
  section.findings.push_back(
      fmt::format("{}: kernels take {:.0f} ms; to read and write each of their buffers once takes "
                  "{:.0f} ms at {:.1f} GB/s.",
                  what, all_ms, memory_ms, 1e-9 * limits.bytes_a_second));
  add_plot(bench, file, std::move(series), section);
  section.tables.push_back(std::move(table));
}

void add_scene(const Bench& bench, const std::string& scene, const std::string& setting,
               const Limits& limits, Section& section) {
  const std::string name = scene + " " + setting;
  bench.step(name);
  const int width = bench.size(1920), height = bench.size(1080);
  const Subject subject = make_subject(bench.backend, make_scene(scene, width, height), setting);
  const Uses uses = uses_of(
      bench, name, [&](Backend& backend) { return render(backend, subject, default_chain()); });
  add_uses(bench, scene, fmt::format("{}, {} x {}, default", name, width, height), uses, limits,
           section);
  const std::size_t points = ray_plan(*default_chain().chain, false).lens.points.size();
  const double rays = static_cast<double>(subject.frame().pixels() * points);
  const double rays_s = uses.at("rdb_gather").median_s();
  section.findings.push_back(fmt::format(
      "{}: {:.2f} G rays a second end in `rdb_gather`, {:.0f} % of the {:.1f} G tests a second "
      "that vectors in registers do.",
      name, 1e-9 * rays / rays_s, 100 * rays / rays_s / limits.tests_a_second,
      1e-9 * limits.tests_a_second));
}

void add_splats(const Bench& bench, const Limits& limits, Section& section) {
  bench.step("figure");
  const SplatShot shot = make_splat_shot("figure", 3.2, 0);
  const int side = bench.size(512);
  SplatReport report;
  const Uses uses = uses_of(bench, shot.name, [&](Backend& backend) {
    return draw_splats(backend, shot.tree, splat_view(shot, side, side, 500), true, 0, report)
        .colour;
  });
  add_uses(bench, shot.name, fmt::format("figure, {0} x {0}, 500 mm", side), uses, limits, section);
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
  add_scene(bench, "fence", "bg", limits, section);
  add_scene(bench, "spheres", "f2", limits, section);
  add_splats(bench, limits, section);
  return section;
}

}  // namespace defray::perf
