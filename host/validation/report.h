#pragma once
// What a validation found, for people (one HTML file) and machines (JSON).
#include <functional>
#include <string>
#include <vector>

#include "measure/html_report.h"
#include "validation/validation.h"

namespace defray::validation {

/// The command that runs one case again.
using CommandOf = std::function<std::string(const DeviceResult&, const std::string& kernel,
                                            const std::string& case_text)>;

/// The page's parts: summary first, then a device each with its pictures (written to `folder`).
std::vector<Section> to_sections(const std::vector<DeviceResult>& devices,
                                 const std::vector<std::string>& notes, const std::string& folder,
                                 const CommandOf& command_of);

/// The report as JSON text.
std::string to_json(const std::vector<DeviceResult>& devices, const std::vector<std::string>& notes,
                    const std::string& level, const CommandOf& command_of);

}  // namespace defray::validation
