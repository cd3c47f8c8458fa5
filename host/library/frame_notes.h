#pragma once
// What looks like a mistake, though a picture can be made of it: a note each, with the number.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "defray/options.h"
#include "defray/report.h"
#include "image/depth_plane.h"
#include "lens/lens.h"

namespace defray {

/// On depth as the file has it and as it was read.
void note_depth(const DepthPlane& depth, const DepthSettings& settings, const DepthReport& report,
                std::vector<std::string>& notes);

/// On a focus outside all depths.
void note_focus(const Lens& lens, const DepthReport& report, std::vector<std::string>& notes);

/// On CoCs of which the largest is too small to be seen, unless it is a pinhole's.
void note_small_coc(const Lens& lens, double largest_px, std::vector<std::string>& notes);

/// On CoCs that are too small to be seen, or larger than anything but a mistake makes them.
void note_coc(const Lens& lens, std::span<const std::int32_t> coc_quanta, int display_width,
              std::vector<std::string>& notes);

/// On a target that no quality is expected to reach.
void note_target(const std::optional<ExpectedError>& expected, const ErrorSettings& wanted,
                 std::vector<std::string>& notes);

/// That the fastest quality is not fast enough.
void note_budget(const BudgetChoice& choice, std::vector<std::string>& notes);

}  // namespace defray
