#pragma once
// How a case of a validation is run again.
#include <string>

#include "validation/validation.h"

namespace defray::cli {

/// "defray validate --device … --kernel … --case …".
std::string case_command(const validation::DeviceResult& device, const std::string& kernel,
                         const std::string& case_text);

}  // namespace defray::cli
