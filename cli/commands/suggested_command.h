#pragma once
// What defray info suggests.
#include <string>

#include "library/file_info.h"

namespace defray::cli {

/// The command that renders the file, as a shell takes it; empty where something is missing.
std::string suggested_command(const FileInfo& info);

}  // namespace defray::cli
