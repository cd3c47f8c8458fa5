#pragma once
// The ray distribution buffer's cells laid open: which source wins each, on a device and by twin.
#include <cstdint>
#include <vector>

#include "frame/backend.h"
#include "rdb/rdb.h"

namespace defray {
class Session;
}

namespace defray::validation {

/// Every cell's winner, [cell][pixel]: the fragment's index in the frame, or -1 where no ray
/// arrives. -2 where the key beside a winner is not its own.
std::vector<std::int64_t> winners_on_device(Session& session, const Frame& frame,
                                            const RayPlan& plan);
std::vector<std::int64_t> winners_of_twin(const Frame& frame, const RayPlan& plan);

/// Words of a buffer of `cells`^2 cells a pixel that held 7s before kernel `rdb_clear`, and some
/// beyond its end, which it must leave alone.
std::vector<std::uint32_t> cleared_on_device(Session& session, int width, int height, int cells);
std::vector<std::uint32_t> cleared_twin(int width, int height, int cells);

}  // namespace defray::validation
