#pragma once
// What a device of the API is made of.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "defray/device.h"
#include "frame/backend.h"
#include "tuning/cost_model.h"

namespace defray {

/// Alive as long as the device.
Backend& backend_of(Device& device);

/// What is known of a device's speed.
struct Costs {
  std::string path;  ///< Of the file that keeps it; empty: none does.
  tuning::Key key;
  tuning::CostModel model;
  std::string notice = {};                       ///< Why the file was not used.
  std::map<std::string, std::size_t> last = {};  ///< Rung that was chosen last, by class of frames.
  std::set<Quality> used = {};                   ///< In this process.
};

/// Read when first asked for; alive as long as the device.
Costs& costs_of(Device& device);

/// From here on work-groups are those tuned for such frames; names those that are used so, as
/// "fill=16x1".
std::vector<std::string> use_tuning(Device& device, const std::string& frame_class);

}  // namespace defray
