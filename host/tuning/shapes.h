#pragma once
// Which work-groups to try, and in which order.
#include <optional>

#include "tuning/results.h"

namespace defray::tuning {

/// A device, as far as work-groups go.
struct Machine {
  std::size_t most_items;
  bool is_gpu = false;
};

/// The launch table's. Throws Error(device) for a kernel that there is not.
Shape own_shape(const std::string& kernel, bool on_gpu);

/// Powers of two, as many work-items as the device allows, the launch table's first.
std::vector<Shape> shapes_of(const std::string& kernel, const Machine& machine);

/// The work-group to explore next: the launch table's; then, in turn, one beside the best so far
/// and one by chance (the same chance in every run); those that were not tried yet. None: all were.
std::optional<Shape> next_to_explore(const std::vector<Result>& results, const Place& place,
                                     const Machine& machine);

/// The work-group to measure once more: the launch table's and the two fastest in turn, that of
/// the fewest runs first.
Shape next_to_confirm(const std::vector<Result>& results, const Place& place, bool on_gpu);

}  // namespace defray::tuning
