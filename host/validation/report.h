#pragma once
// What a validation found, for people (one HTML file) and machines (JSON).
#include <string>
#include <vector>

#include "measure/html_report.h"
#include "validation/validation.h"

namespace defray::validation {

/// "defray validate --device … --kernel … --case …": runs one case again.
std::string command_of(const DeviceResult& device, const std::string& kernel,
                       const std::string& case_text);

/// The page's parts: summary first, then a device each with its pictures (written to `folder`).
std::vector<Section> to_sections(const std::vector<DeviceResult>& devices,
                                 const std::vector<std::string>& notes, const std::string& folder);

/// The report as JSON text.
std::string to_json(const std::vector<DeviceResult>& devices, const std::vector<std::string>& notes,
                    const std::string& level);

}  // namespace defray::validation
