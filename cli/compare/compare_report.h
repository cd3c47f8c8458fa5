#pragma once
// What compare says.
#include "compare/comparison.h"

namespace defray::cli {

/// One JSON object a line. `frame`: of a sequence.
void print_json(const Found& found, std::optional<int> frame);

void print_text(const Found& found, std::optional<int> frame);

/// What a line says of several frames.
void print_summary(const std::vector<Found>& frames, const std::vector<int>& numbers);

}  // namespace defray::cli
