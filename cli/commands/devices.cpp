// defray devices: what OpenCL offers on this machine.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "commands.h"
#include "defray/device.h"

namespace defray::cli {
namespace {

void print_text(const std::vector<DeviceProperties>& devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceProperties& d = devices[i];
    fmt::print("{}: {}\n", i, d.name);
    fmt::print("   platform    {}, {}\n", d.platform, d.version);
    fmt::print("   type        {}, {} compute units, work-groups up to {}\n", d.type,
               d.compute_units, d.max_work_group);
    fmt::print("   memory      {} MiB, largest buffer {} MiB, local {} KiB\n",
               d.global_memory_bytes >> 20, d.max_buffer_bytes >> 20, d.local_memory_bytes >> 10);
    fmt::print("   64-bit atomics {}, double {}\n",
               d.has_int64_atomics ? "yes" : "no (two-pass scatter)", d.has_double ? "yes" : "no");
  }
  fmt::print("reference: the scalar twins, one thread, no OpenCL\n");
}

void print_json(const std::vector<DeviceProperties>& devices) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const DeviceProperties& d : devices) {
    list.push_back({{"name", d.name},
                    {"platform", d.platform},
                    {"version", d.version},
                    {"type", d.type},
                    {"compute_units", d.compute_units},
                    {"max_work_group", d.max_work_group},
                    {"global_memory_bytes", d.global_memory_bytes},
                    {"max_buffer_bytes", d.max_buffer_bytes},
                    {"local_memory_bytes", d.local_memory_bytes},
                    {"int64_atomics", d.has_int64_atomics},
                    {"double", d.has_double}});
  }
  fmt::print("{}\n", list.dump());
}

}  // namespace

Run add_devices(CLI::App& app) {
  CLI::App* command = app.add_subcommand("devices", "List OpenCL devices");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print one JSON array instead of text");
  command->footer(
      "Use an index or a part of a name with 'defray render --device'.\n"
      "Example: defray devices --json");
  return [json] {
    const std::vector<DeviceProperties> devices = Device::list();
    if (*json) {
      print_json(devices);
    } else {
      print_text(devices);
    }
    if (devices.empty()) {
      fail(ErrorKind::device,
           "no OpenCL device found: install one (Debian: apt-get install pocl-opencl-icd)");
    }
    return 0;
  };
}

}  // namespace defray::cli
