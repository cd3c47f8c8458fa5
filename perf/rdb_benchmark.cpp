// The ray distribution buffer alone, 13x13 cells, in rays a second: pixels x round cells.
//
// Before rays are timed as a whole, their picture is checked: at 160x120 against the scalar twin,
// which is also timed, and gather against scatter. The baseline is the scatter of the same run. Use
// --benchmark_repetitions=5 for median and spread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/stopwatch.h"
#include "device/device_backend.h"
#include "device/rdb_scatter.h"
#include "lens/lens.h"
#include "reference/twin_backend.h"

namespace {

using namespace defray;

/// Near discs over a receding floor: depths continuous and not, CoC from 0 to `radius` either way.
Frame make_frame(int width, int height, int radius) {
  std::vector<std::int32_t> coc;
  Plane depth;
  std::vector<Plane> colour(4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = double(x) / width, v = double(y) / height;
      const double disc = std::hypot(std::fmod(u * 5, 1.0) - 0.5, std::fmod(v * 4, 1.0) - 0.5);
      const double z = disc < 0.3 ? 2.6 + u : 5 / (0.55 + 0.9 * v);
      coc.push_back(static_cast<std::int32_t>(std::lround(256 * radius * (z - 5) / z)));
      depth.push_back(static_cast<float>(z));
      for (std::size_t c = 0; c < 4; ++c) {
        colour[c].push_back(static_cast<float>(((x >> c) ^ (y >> c)) & 1));
      }
    }
  }
  return {width, height, std::move(coc), std::move(depth), colour};
}

Session& session() {
  static Session& shared = *new Session(select_device(""));  // outlives the OpenCL runtime
  return shared;
}

DeviceBackend& device() {
  static DeviceBackend& shared = *new DeviceBackend(session());
  return shared;
}

RayPlan plan(RaysBy by = RaysBy::gather) {
  RdbSettings settings;
  settings.cells_per_side = 13;
  settings.rays = by;
  return plan_rays(settings);
}

double rays(const Frame& frame) {
  return double(frame.pixels()) * double(plan().lens.points.size());
}

Values<float> in_host_memory(const Values<float>& v) {
  return Values<float>::view(v.begin(), v.size());
}

/// The same frame, on no device yet: its way there is timed too.
Frame in_host_memory(const Frame& f) {
  const auto coc = Quanta::view(f.coc_quanta.begin(), f.coc_quanta.size());
  Frame view{f.width, f.height, coc, in_host_memory(f.depth), {}};
  for (const Values<float>& channel : f.channels) view.channels.push_back(in_host_memory(channel));
  return view;
}

std::vector<Plane> render(Backend& backend, const Frame& f, RaysBy by) {
  return backend.rays(in_host_memory(f), plan(by)).means;
}

/// Whether the picture is the twin's, bit for bit, on 160 x 120, and by gather the scatter's at its
/// own size.
bool is_correct(const Frame& frame, int radius, RaysBy by) {
  const Frame f = make_frame(160, 120, radius);
  reference::TwinBackend backend;
  if (render(device(), f, by) != render(backend, f, by)) return false;
  return by == RaysBy::scatter ||
         render(device(), frame, by) == render(device(), frame, RaysBy::scatter);
}

void set_rate(benchmark::State& state, double items, const char* name) {
  state.counters[name] = benchmark::Counter(items, benchmark::Counter::kIsIterationInvariantRate);
}

Frame frame_of(const benchmark::State& state) {
  return make_frame(int(state.range(0)), int(state.range(1)), int(state.range(2)));
}

void coc(benchmark::State& state) {
  const Frame f = frame_of(state);
  Lens lens;
  lens.focus_distance_units = 5;
  for (auto _ : state) {
    const Quanta coc = device().coc(lens, f.width, in_host_memory(f.depth));
    benchmark::DoNotOptimize(coc.host());  // waits for it
  }
  set_rate(state, double(f.width) * f.height, "pixels/s");
}

/// Clears and scatters every pass of a frame.
void rdb_scatter(benchmark::State& state) {
  const Frame f = frame_of(state);
  const RayPlan rays_plan = plan(RaysBy::scatter);
  RdbScatter run(session(), f, rays_plan);
  for (auto _ : state) {
    for (const RdbPass& pass : run.passes()) run.scatter(pass);
    run.finish();
  }
  set_rate(state, rays(f), "rays/s");
}

/// Merges every pass of a frame; the scatter before each is not timed.
void rdb_merge(benchmark::State& state) {
  const Frame f = frame_of(state);
  const RayPlan rays_plan = plan(RaysBy::scatter);
  RdbScatter run(session(), f, rays_plan);
  RayResult out{std::vector<Plane>(f.channels.size(), Plane(f.pixels())),
                std::vector<std::uint32_t>(f.pixels())};
  for (auto _ : state) {
    double merging_s = 0;
    for (const RdbPass& pass : run.passes()) {
      if (pass.first_cell == 0) run.begin_band(pass, out);
      run.scatter(pass);
      run.finish();
      const Stopwatch watch;
      run.merge(pass);
      run.finish();
      merging_s += watch.seconds();
    }
    state.SetIterationTime(merging_s);
  }
  set_rate(state, rays(f), "rays/s");
}

/// The scalar twin, one thread: the baseline of the same run.
void scalar_twin(benchmark::State& state) {
  const Frame f = frame_of(state);
  reference::TwinBackend backend;
  for (auto _ : state) benchmark::DoNotOptimize(render(backend, f, RaysBy::scatter));
  set_rate(state, rays(f), "rays/s");
}

template <RaysBy by>
void rays_by(benchmark::State& state) {
  const Frame f = frame_of(state);
  if (!is_correct(f, int(state.range(2)), by)) {
    state.SkipWithError("the picture is not the twin's, or not the scatter's");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(render(device(), f, by));
  set_rate(state, rays(f), "rays/s");
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"width", "height", "radius"})->Unit(benchmark::kMillisecond);
  for (const int radius : {8, 32, 128}) b->Args({1920, 1080, radius});
}

}  // namespace

BENCHMARK(coc)->Apply(sizes)->UseRealTime();
BENCHMARK(rdb_scatter)->Apply(sizes)->UseRealTime();
BENCHMARK(rdb_merge)->Apply(sizes)->UseManualTime();
BENCHMARK(rays_by<RaysBy::scatter>)->Name("rays_scatter")->Apply(sizes)->UseRealTime();
BENCHMARK(rays_by<RaysBy::gather>)->Name("rays_gather")->Apply(sizes)->UseRealTime();
BENCHMARK(scalar_twin)
    ->ArgNames({"width", "height", "radius"})
    ->Args({640, 480, 8})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK_MAIN();
