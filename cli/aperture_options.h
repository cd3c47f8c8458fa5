#pragma once
// The options that shape the aperture, shared by every command that renders.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "lens/aperture.h"

namespace defray::cli {

/// As typed; empty where not given.
struct ApertureOptions {
  std::optional<int> blades;
  std::optional<double> curvature, rotation_deg, squeeze, cats_eye;
  std::string image;
};

void add_aperture_options(CLI::App& command, ApertureOptions& options);

/// Throws Error(usage) on values that are not allowed.
Aperture to_aperture(const ApertureOptions& options);

}  // namespace defray::cli
