#pragma once
// Functions that were reached, for `mutate.sh` (reached.cpp).
#include <string>

namespace defray::test {

void clear_reached();

/// " host_tests:12 host_tests:40 defray:7 ..."
std::string reached();

}  // namespace defray::test
