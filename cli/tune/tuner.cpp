#include "tune/tuner.h"

#include <algorithm>

#include "base/error.h"
#include "base/stopwatch.h"
#include "tuning/shapes.h"

namespace defray::cli {
namespace {

constexpr double least_share = 0.02;
/// Of the time: the rest confirms.
constexpr double share_to_explore = 0.5;
/// Runs of a kernel's own work-group and its fastest ones after which nothing is left to learn.
constexpr std::size_t enough_runs = 9;

tuning::Machine machine_of(const Device& device) {
  const DeviceProperties& properties = device.properties();
  return {properties.max_work_group, properties.is_gpu()};
}

}  // namespace

Tuner::Tuner(Device& device, std::string path, std::vector<std::string> kernels)
    : device_(device),
      path_(std::move(path)),
      key_(tuning::key_of(device.properties())),
      kernels_(std::move(kernels)) {
  keep({});
}

void Tuner::keep(const std::vector<tuning::Result>& results) {
  results_ = tuning::add(path_, key_, device_.properties().max_work_group, results);
}

void Tuner::set(const Shapes& shapes) {
  device_.set_work_group(0, 0);
  for (const auto& [kernel, shape] : shapes) device_.set_work_group(kernel, shape.x, shape.y);
}

Tuner::Milliseconds Tuner::draw(const Shapes& shapes) {
  set(shapes);
  bool is_compiled = true;
  for (const auto& one : shapes) is_compiled &= !compiled_.insert(one).second;
  bool is_right = true;
  if (!is_compiled) {
    // Devices compile for a work-group when it is first used: not in the time that is kept.
    is_right =
        workload_->draw_small(device_) == expected_small_ && workload_->draw(device_) == expected_;
  }
  device_.take_kernel_seconds();
  is_right = is_right && workload_->draw(device_) == expected_;
  Milliseconds taken;
  if (!is_right) return taken;
  for (const auto& [kernel, seconds] : device_.take_kernel_seconds()) {
    taken[kernel] = 1000 * seconds;
  }
  return taken;
}

std::vector<tuning::Result> Tuner::tries(const Shapes& shapes) {
  tuning::Validity validity = tuning::Validity::correctness;
  Milliseconds taken;
  try {
    taken = draw(shapes);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::device) throw;
    validity = tuning::Validity::runtime;
  }
  std::vector<tuning::Result> results;
  for (const auto& [kernel, shape] : shapes) {
    tuning::Result result{place_of(kernel), shape, tuning::Validity::correct, {}};
    if (!taken.empty()) {
      result.run_ms.push_back(taken.at(kernel));
      results.push_back(result);
    } else if (shapes.size() == 1) {
      result.validity = validity;
      results.push_back(result);
    } else {
      compiled_.erase({kernel, shape});
      for (tuning::Result& r : tries({{kernel, shape}})) results.push_back(std::move(r));
    }
  }
  return results;
}

Tuner::Milliseconds Tuner::start(const Workload& workload) {
  workload_ = &workload;
  Device reference = Device::reference();
  expected_small_ = workload.draw_small(reference);
  set({});
  if (workload.draw_small(device_) != expected_small_) {
    fail(ErrorKind::device, "{}: pictures are not those of the scalar twins; see 'defray validate'",
         device_.name());
  }
  expected_ = workload.draw(device_);
  return draw({});
}

Tuner::Shapes Tuner::next_shapes(const std::vector<std::string>& kernels, bool explores) const {
  const tuning::Machine machine = machine_of(device_);
  Shapes shapes;
  for (const std::string& kernel : kernels) {
    std::optional<tuning::Shape> next;
    if (explores) next = tuning::next_to_explore(results_, place_of(kernel), machine);
    shapes[kernel] =
        next ? *next : tuning::next_to_confirm(results_, place_of(kernel), machine.is_gpu);
  }
  return shapes;
}

bool Tuner::is_done(const std::vector<std::string>& kernels) const {
  const tuning::Machine machine = machine_of(device_);
  return std::all_of(kernels.begin(), kernels.end(), [&](const std::string& kernel) {
    const tuning::Place place = place_of(kernel);
    if (tuning::next_to_explore(results_, place, machine)) return false;
    const tuning::Shape least = tuning::next_to_confirm(results_, place, machine.is_gpu);
    return std::any_of(results_.begin(), results_.end(), [&](const tuning::Result& r) {
      return r.place == place && r.shape == least && r.run_ms.size() >= enough_runs;
    });
  });
}

std::string Tuner::best_so_far() const {
  const tuning::Finding* best = nullptr;
  const auto all = tuning::findings(results_, device_.properties().is_gpu());
  for (const tuning::Finding& f : all) {
    if (f.place != place_of(f.place.kernel) || f.best == f.own) continue;
    if (!best || f.own_ms - f.best_ms > best->own_ms - best->best_ms) best = &f;
  }
  if (!best) return "";
  return fmt::format("{} {}, {:.0f} % sooner", best->place.kernel, to_string(best->best),
                     100 * best->gain());
}

void Tuner::run(const Workload& workload, double seconds, const TuneProgress& progress) {
  const Stopwatch watch;
  const Milliseconds taken = start(workload);
  double all = 0;
  for (const auto& [kernel, ms] : taken) all += ms;
  std::vector<std::string> kernels;
  for (const auto& [kernel, ms] : taken) {
    const bool is_wanted =
        kernels_.empty() ? ms >= least_share * all
                         : std::find(kernels_.begin(), kernels_.end(), kernel) != kernels_.end();
    if (is_wanted) kernels.push_back(kernel);
  }
  tuned_.insert(kernels.begin(), kernels.end());
  if (kernels.empty()) return;
  double passed = watch.seconds(), step = 0;
  do {
    progress(passed, best_so_far());
    keep(tries(next_shapes(kernels, passed < share_to_explore * seconds)));
    step = watch.seconds() - passed;
    passed += step;
  } while (passed + step < seconds && !is_done(kernels));
  set({});
}

}  // namespace defray::cli
