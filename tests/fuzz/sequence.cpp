// Frame ranges and frame patterns. First line: --frames; second: a file name.
#include "image/sequence.h"

#include <algorithm>

#include "fuzz.h"

using namespace defray;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const std::string range = bytes.line();
  fuzz::run_parser([&] {
    std::vector<int> frames = parse_frames(range);
    fuzz::require(!frames.empty() && frames.size() <= 1000000);
    std::sort(frames.begin(), frames.end());
    fuzz::require(std::adjacent_find(frames.begin(), frames.end()) == frames.end());
  });
  const std::string name = bytes.line();
  fuzz::run_parser([&] {
    const bool has_pattern = has_frame_pattern(name);
    const std::string one = frame_path(name, 7), other = frame_path(name, -123456789);
    fuzz::require(has_pattern == (one != other));
    fuzz::require(one.size() <= name.size() + 64 && other.size() <= name.size() + 64);
  });
  return 0;
}
