#include "defray/device.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "device/device_backend.h"
#include "library/backend_of.h"
#include "opencl/session.h"
#include "reference/twin_backend.h"

namespace defray {

struct Device::State {
  std::string name;
  std::optional<Session> session;  ///< None: the reference.
  std::unique_ptr<Backend> backend;
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
  if (name == "reference") return reference();
  SessionOptions session;
  session.math = options.math;
  const DeviceInfo info =
      select_device(name, "; or use " + field("device") + " reference, the slow scalar twin");
  auto state = std::make_unique<State>();
  state->name = info.name + (options.math == Math::fast ? " (fast arithmetic)" : "");
  state->session.emplace(info, session);
  state->backend = std::make_unique<DeviceBackend>(*state->session);
  return Device(std::move(state));
}

Device Device::reference() {
  auto state = std::make_unique<State>();
  state->name = "the scalar reference";
  state->backend = std::make_unique<reference::TwinBackend>();
  return Device(std::move(state));
}

const std::string& Device::name() const { return state_->name; }

Device::State& Device::state_on_device(const char* setting) {
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
    fail(ErrorKind::usage, "{}: no kernel is called '{}'.{} There are: {}", field("work_group"),
         kernel, did_you_mean(kernel, kernels), join(kernels, " "));
  }
  session.set_work_group(kernel, x, y);
}

Backend& backend_of(Device& device) { return *device.state_->backend; }

}  // namespace defray
