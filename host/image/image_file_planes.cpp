// One channel of a file's pixels, which lie channel by channel beside each other.
#include <cstring>

#include "base/parallel.h"
#include "image/image_file_part.h"

namespace defray {
namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// Copies values of so many bytes that lie `from_stride` and `to_stride` apart.
template <std::size_t bytes>
void copy_values(const std::byte* from, std::size_t from_stride, std::byte* to,
                 std::size_t to_stride, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to + i * to_stride, from + i * from_stride, bytes);
  }
}

/// Where a channel's values lie in a part's pixels.
struct Channel {
  Channel(const ImageSpec& spec, int channel)
      : format(spec.channelformat(channel)),
        bytes(spec.channel_bytes(channel, true)),
        offset(spec.pixel_bytes(0, channel, true)),
        stride(spec.pixel_bytes(true)),
        width(static_cast<std::size_t>(spec.width)),
        height(spec.height) {}

  std::size_t row(int y) const { return static_cast<std::size_t>(y) * width * stride + offset; }

  void copy(const std::byte* from, std::size_t from_stride, std::byte* to,
            std::size_t to_stride) const {
    const auto copy_row = bytes == 1   ? copy_values<1>
                          : bytes == 2 ? copy_values<2>
                          : bytes == 4 ? copy_values<4>
                                       : copy_values<8>;
    copy_row(from, from_stride, to, to_stride, width);
  }

  TypeDesc format;
  std::size_t bytes, offset, stride, width;
  int height;
};

}  // namespace

// OpenImageIO converts rows of one channel at once, but pixels that lie apart one by one, each by a
// call: ten times as slow.

Plane ImageFile::plane(int part, int channel) const {
  const Part& p = parts_.at(static_cast<std::size_t>(part));
  const Channel c(p.spec, channel);
  Plane out(c.width * static_cast<std::size_t>(c.height));
  parallel_for(c.height, [&](int y) {
    std::vector<std::byte> row(c.width * c.bytes);
    c.copy(&p.pixels[c.row(y)], c.stride, row.data(), c.bytes);
    OIIO::convert_pixel_values(c.format, row.data(), TypeDesc::FLOAT,
                               &out[static_cast<std::size_t>(y) * c.width], p.spec.width);
  });
  return out;
}

void ImageFile::set_plane(int part, int channel, const Plane& plane) {
  Part& p = parts_.at(static_cast<std::size_t>(part));
  const Channel c(p.spec, channel);
  parallel_for(c.height, [&](int y) {
    std::vector<std::byte> row(c.width * c.bytes);
    OIIO::convert_pixel_values(TypeDesc::FLOAT, &plane[static_cast<std::size_t>(y) * c.width],
                               c.format, row.data(), p.spec.width);
    c.copy(row.data(), c.bytes, &p.pixels[c.row(y)], c.stride);
  });
}

void ImageFile::move_values(int part, int channel, const std::vector<std::uint32_t>& from) {
  Part& p = parts_.at(static_cast<std::size_t>(part));
  const Channel c(p.spec, channel);
  std::vector<std::byte> values;
  for (const std::uint32_t source : from) {
    const auto first = p.pixels.begin() + static_cast<std::ptrdiff_t>(source * c.stride + c.offset);
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(c.bytes));
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::copy_n(&values[i * c.bytes], c.bytes, &p.pixels[i * c.stride + c.offset]);
  }
}

}  // namespace defray
