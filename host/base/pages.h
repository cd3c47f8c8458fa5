#pragma once
// Memory that goes back to the system while its owner keeps the addresses.
#include <cstddef>

namespace defray {

/// Gives back the pages that lie wholly within; what they held is lost, and they may be written
/// again. Where the system knows no such thing they stay.
void give_back_pages(void* first, std::size_t bytes);

}  // namespace defray
