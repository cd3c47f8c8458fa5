#pragma once
// What the command line calls the fields of the library's settings.
#include <string>

#include "base/error.h"

namespace defray::cli {

/// "focus_distance_units" -> "--focus"; "cats_eye" -> "--cats-eye".
std::string option_of_field(const std::string& field);

/// What to tell the user: options instead of fields.
std::string message_of(const Error& error);

}  // namespace defray::cli
