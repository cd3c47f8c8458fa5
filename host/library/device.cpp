#include "defray/device.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "device/device_backend.h"
#include "library/backend_of.h"
#include "opencl/session.h"
#include "reference/twin_backend.h"
#include "tuning/tuning_file.h"

namespace defray {

struct Device::State {
  std::string name;
  std::optional<Session> session;  ///< None: the reference.
  std::unique_ptr<Backend> backend;
  std::vector<tuning::Result> tried = {};
  std::vector<std::string> notes = {};
  std::optional<Costs> costs = {};
};

Device::Device(std::unique_ptr<State> state) : state_(std::move(state)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

std::vector<DeviceProperties> Device::list() {
  const std::vector<DeviceInfo> devices = list_devices();
  return {devices.begin(), devices.end()};
}

Device Device::open(const std::string& name, const DeviceOptions& options) {
  require_named("math", options.math, Math::fast);
  if (name == "reference") return reference();
  SessionOptions session;
  session.math = options.math;
  session.measures = options.measures;
  const DeviceInfo info =
      select_device(name, "; or use " + field("device") + " reference, the slow scalar twin");
  auto state = std::make_unique<State>();
  state->name = info.name + (options.math == Math::fast ? " (fast arithmetic)" : "");
  state->session.emplace(info, session);
  state->backend = std::make_unique<DeviceBackend>(*state->session);
  if (options.use_tuning) {
    const tuning::Key key = tuning::key_of(info);
    tuning::Tuning known = tuning::read(tuning::path_of(key), key, info.max_work_group);
    state->tried = std::move(known.results);
    if (!known.notice.empty()) state->notes.push_back(std::move(known.notice));
  }
  return Device(std::move(state));
}

Device Device::reference() {
  auto state = std::make_unique<State>();
  state->name = "the scalar reference";
  state->backend = std::make_unique<reference::TwinBackend>();
  return Device(std::move(state));
}

const std::string& Device::name() const { return state_->name; }
const std::vector<std::string>& Device::notes() const { return state_->notes; }

const DeviceProperties& Device::properties() const {
  return state_on_device("properties").session->info();
}

std::map<std::string, double> Device::take_kernel_seconds() {
  return state_on_device("measures").session->take_kernel_seconds();
}

Device::State& Device::state_on_device(const char* setting) const {
  if (!state_->session) {
    fail(ErrorKind::usage, "{} means nothing to {} reference", field(setting), field("device"));
  }
  return *state_;
}

void Device::set_memory(std::size_t bytes) {
  if (bytes == 0) fail(ErrorKind::usage, "{} is 0: it must be above 0", field("memory"));
  state_on_device("memory").session->set_memory(bytes);
}

void Device::set_work_group(std::size_t x, std::size_t y) {
  state_on_device("work_group").session->set_work_group(x, y);
}

void Device::set_work_group(const std::string& kernel, std::size_t x, std::size_t y) {
  Session& session = *state_on_device("work_group").session;
  const std::vector<std::string> kernels = session.kernel_names();
  if (std::find(kernels.begin(), kernels.end(), kernel) == kernels.end()) {
    fail(ErrorKind::usage, "{}", not_known(field("work_group") + ": kernel", kernel, kernels));
  }
  session.set_work_group(kernel, x, y);
}

Backend& backend_of(Device& device) { return *device.state_->backend; }

Costs& costs_of(Device& device) {
  std::optional<Costs>& costs = device.state_->costs;
  if (costs) return *costs;
  costs.emplace();
  if (!device.state_->session) return *costs;
  costs->key = tuning::key_of(device.state_->session->info());
  costs->path = tuning::device_path("cost", costs->key);
  costs->model = tuning::read_costs(costs->path, costs->key, costs->notice);
  return *costs;
}

std::vector<std::string> use_tuning(Device& device, const std::string& frame_class) {
  std::vector<std::string> used;
  std::optional<Session>& session = device.state_->session;
  if (!session) return used;
  std::map<std::string, std::array<std::size_t, 2>> groups;
  const auto shapes = tuning::adopted(device.state_->tried, frame_class, session->info().is_gpu());
  for (const auto& [kernel, shape] : shapes) {
    groups[kernel] = {shape.x, shape.y};
  }
  session->set_tuned(std::move(groups));
  for (const auto& [kernel, group] : session->tuned()) {
    used.push_back(fmt::format("{}={}x{}", kernel, group[0], group[1]));
  }
  return used;
}

}  // namespace defray
