#include "validate/case_command.h"

#include <fmt/format.h>

#include "options/shell_quoted.h"

namespace defray::cli {
namespace {

/// What has to stand before a command that shall see the device.
const char* way_to(const validation::DeviceResult& device) {
  if (device.platform == "rusticl") return "RUSTICL_ENABLE=llvmpipe ";
  return device.platform == "Oclgrind" ? "oclgrind " : "";
}

}  // namespace

std::string case_command(const validation::DeviceResult& device, const std::string& kernel,
                         const std::string& case_text) {
  return fmt::format("{}defray validate --device {} --math {} --kernel {} --case {} -o case",
                     way_to(device), shell_quoted(device.device), device.math, kernel, case_text);
}

}  // namespace defray::cli
