// The choice of colour and depth among channel names. Lines: the layer, view and depth channel
// asked for, then the file, where a line's first character says what it is: p a part, v its view,
// s a view of a stereo part, anything else a channel.
#include "image/channels.h"

#include "fuzz.h"

using namespace defray;

namespace {

std::vector<PartInfo> parts_of(fuzz::Bytes& bytes) {
  std::vector<PartInfo> parts(1);
  while (!bytes.is_empty()) {
    const std::string line = bytes.line();
    const std::string value = line.empty() ? "" : line.substr(1);
    const char kind = line.empty() ? ' ' : line[0];
    if (kind == 'p') {
      parts.emplace_back().name = value;
    } else if (kind == 'v') {
      parts.back().view = value;
    } else if (kind == 's') {
      parts.back().views.push_back(value);
    } else {
      parts.back().channels.push_back(value);
    }
  }
  return parts;
}

bool has_channel(const std::vector<PartInfo>& parts, int part, int channel) {
  const auto p = static_cast<std::size_t>(part), c = static_cast<std::size_t>(channel);
  return p < parts.size() && c < parts[p].channels.size();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const ChannelRequest request{bytes.line(), bytes.line(), bytes.line()};
  const std::vector<PartInfo> parts = parts_of(bytes);
  ColourChoice colour;
  fuzz::run_parser([&] {
    colour = choose_colour("in.exr", parts, request);
    fuzz::require(!colour.channels.empty() && colour.channels.size() <= 4);  // Y YA RGB RGBA
    for (const int channel : colour.channels) {
      fuzz::require(has_channel(parts, colour.part, channel));
    }
  });
  fuzz::run_parser([&] {
    const ChannelName depth = choose_depth("in.exr", parts, request, colour);
    fuzz::require(has_channel(parts, depth.part, depth.channel));
  });
  return 0;
}
