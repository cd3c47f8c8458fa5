#include "image/image_file.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "image/image_file_part.h"

namespace defray {
namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

std::vector<std::string> string_list(const ImageSpec& spec, const std::string& name) {
  const OIIO::ParamValue* value = spec.find_attribute(name);
  std::vector<std::string> list;
  if (!value || value->type().basetype != TypeDesc::STRING) return list;
  for (int i = 0; i < static_cast<int>(value->type().numelements()); ++i) {
    list.push_back(value->get_string_indexed(i));
  }
  return list;
}

std::int64_t pixel_count(const ImageSpec& spec) { return std::int64_t{spec.width} * spec.height; }

/// Where a channel starts in a pixel, bytes.
std::size_t channel_offset(const ImageSpec& spec, int channel) {
  return spec.pixel_bytes(0, channel, true);
}

}  // namespace

ImageFile::ImageFile() = default;
ImageFile::ImageFile(ImageFile&&) noexcept = default;
ImageFile& ImageFile::operator=(ImageFile&&) noexcept = default;
ImageFile::~ImageFile() = default;

ImageFile ImageFile::from_planes(const std::vector<std::string>& channels,
                                 const std::vector<Plane>& planes, int width, int height,
                                 Sample sample) {
  ImageFile file;
  Part part;
  part.spec = ImageSpec(width, height, static_cast<int>(channels.size()),
                        sample == Sample::half_float ? TypeDesc::HALF : TypeDesc::FLOAT);
  part.spec.channelnames = channels;
  part.spec.attribute("compression", "zip");
  part.pixels.resize(part.spec.image_bytes(true));
  file.parts_.push_back(std::move(part));
  file.refresh_info();
  for (std::size_t c = 0; c < planes.size(); ++c) {
    file.set_plane(0, static_cast<int>(c), planes[c]);
  }
  return file;
}

void ImageFile::rename_channel(int part, int channel, const std::string& name) {
  parts_.at(static_cast<std::size_t>(part))
      .spec.channelnames.at(static_cast<std::size_t>(channel)) = name;
  refresh_info();
}

void ImageFile::refresh_info() {
  info_.clear();
  for (const Part& part : parts_) {
    const ImageSpec& s = part.spec;
    PartInfo info;
    info.name = s.get_string_attribute("oiio:subimagename");
    info.view = s.get_string_attribute("view");
    info.views = string_list(s, "multiView");
    info.channels = s.channelnames;
    const TypeDesc format = s.channelformat(0);
    info.integer_bits =
        format.is_floating_point() ? encoded_bits_ : 8 * static_cast<int>(format.size());
    info.data = {s.x, s.y, s.width, s.height};
    info.display = {s.full_x, s.full_y, s.full_width, s.full_height};
    info_.push_back(std::move(info));
  }
}

bool ImageFile::holds_integers(int part, int channel) const {
  const auto format = parts_.at(static_cast<std::size_t>(part)).spec.channelformat(channel);
  return format == TypeDesc::UINT || format == TypeDesc::INT;
}

void ImageFile::grow(int part, const Window& data) {
  Part& p = parts_.at(static_cast<std::size_t>(part));
  const ImageSpec from = p.spec;
  const std::vector<std::byte> before = std::move(p.pixels);
  p.spec.x = data.x;
  p.spec.y = data.y;
  p.spec.width = data.width;
  p.spec.height = data.height;
  p.pixels.assign(p.spec.image_bytes(true), std::byte{0});
  const std::size_t pixel = from.pixel_bytes(true), row = from.scanline_bytes(true);
  for (int y = 0; y < from.height; ++y) {
    const std::size_t to =
        static_cast<std::size_t>(from.y + y - data.y) * p.spec.scanline_bytes(true) +
        static_cast<std::size_t>(from.x - data.x) * pixel;
    std::copy_n(before.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row),
                row, p.pixels.begin() + static_cast<std::ptrdiff_t>(to));
  }
  refresh_info();
}

void ImageFile::set_bits(int part, const std::vector<int>& channels, Bits bits) {
  if (bits == Bits::as_input) return;
  Part& p = parts_.at(static_cast<std::size_t>(part));
  const TypeDesc format = bits == Bits::eight     ? TypeDesc::UINT8
                          : bits == Bits::sixteen ? TypeDesc::UINT16
                          : bits == Bits::half    ? TypeDesc::HALF
                                                  : TypeDesc::FLOAT;
  std::vector<TypeDesc> formats;
  std::vector<Plane> planes;
  for (int c = 0; c < p.spec.nchannels; ++c) {
    const bool is_meant =
        channels.empty() || std::find(channels.begin(), channels.end(), c) != channels.end();
    formats.push_back(is_meant ? format : p.spec.channelformat(c));
    planes.push_back(is_meant ? plane(part, c) : Plane());
  }
  const ImageSpec from = p.spec;
  const std::vector<std::byte> before = std::move(p.pixels);
  p.spec.format = format;
  p.spec.channelformats = formats;
  p.pixels.assign(p.spec.image_bytes(true), std::byte{0});
  const std::size_t count = static_cast<std::size_t>(pixel_count(from));
  for (int c = 0; c < from.nchannels; ++c) {
    if (!planes[static_cast<std::size_t>(c)].empty()) {
      set_plane(part, c, planes[static_cast<std::size_t>(c)]);
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      std::copy_n(&before[i * from.pixel_bytes(true) + channel_offset(from, c)],
                  from.channel_bytes(c, true),
                  &p.pixels[i * p.spec.pixel_bytes(true) + channel_offset(p.spec, c)]);
    }
  }
  refresh_info();
}

bool ImageFile::is_lossy() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
    const std::string compression = part.spec.get_string_attribute("compression");
    return compression.starts_with("dwa") || compression.starts_with("jpeg") ||
           compression.starts_with("b44") || compression == "pxr24";
  });
}

bool ImageFile::has_smaller_levels() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
    return part.spec.tile_width > 0 && !part.spec.get_string_attribute("textureformat").empty() &&
           part.spec.get_int_attribute("openexr:levelmode", 1) != 0;
  });
}

void ImageFile::set_compression(const std::string& name) {
  for (Part& part : parts_) part.spec.attribute("compression", name);
}

ImageFile ImageFile::extract(int part, const std::vector<int>& channels) const {
  const ImageSpec& from = parts_.at(static_cast<std::size_t>(part)).spec;
  ImageFile file;
  file.path_ = path_;
  Part to;
  to.spec = from;
  to.spec.nchannels = static_cast<int>(channels.size());
  to.spec.channelformats.clear();
  to.spec.set_format(TypeDesc::FLOAT);
  to.spec.channelnames.clear();
  to.spec.alpha_channel = to.spec.z_channel = -1;
  for (const int c : channels) {
    const std::string& name = from.channelnames[static_cast<std::size_t>(c)];
    to.spec.channelnames.push_back(split(name, '.').back());
    if (to.spec.channelnames.back() == "A") {
      to.spec.alpha_channel = to.spec.nchannels - 1;
    }
  }
  to.pixels.resize(to.spec.image_bytes(true));
  file.parts_.push_back(std::move(to));
  file.refresh_info();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    file.set_plane(0, static_cast<int>(c), plane(part, channels[c]));
  }
  return file;
}

void ImageFile::write(const std::string& path) const {
  const auto output = ImageOutput::create(path);
  if (!output) {
    fail(ErrorKind::output, "{}: unknown image format: {}", path, first_line(OIIO::geterror()));
  }
  const auto check = [&](bool ok) {
    if (!ok) {
      fail(ErrorKind::output, "{}: cannot write: {}", path, first_line(output->geterror()));
    }
  };
  std::vector<ImageSpec> specs;
  for (const Part& part : parts_) {
    specs.push_back(part.spec);
    // Other colours are written; the new file counts its own chunks.
    for (const char* stale :
         {"openexr:chunkCount", "oiio:SHA-1", "oiio:AverageColor", "oiio:ConstantColor"}) {
      specs.back().erase_attribute(stale);
    }
    // The largest level alone was read. An environment stays one, of that level.
    specs.back().erase_attribute("openexr:levelmode");
    const std::string texture = specs.back().get_string_attribute("textureformat");
    if (texture == "Plain Texture")
      specs.back().erase_attribute("textureformat");
    else if (!texture.empty())
      specs.back().attribute("openexr:levelmode", 0);
  }
  if (specs.size() == 1) {
    check(output->open(path, specs.front()));
  } else {
    check(output->open(path, static_cast<int>(specs.size()), specs.data()));
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (i > 0) check(output->open(path, specs[i], ImageOutput::AppendSubimage));
    check(output->write_image(TypeDesc::UNKNOWN, parts_[i].pixels.data()));
  }
  check(output->close());
}

}  // namespace defray
