#include "image/output.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "image/ldr.h"
#include "image/safe_output.h"
#include "kernels/params.h"

namespace defray {
namespace {

const std::vector<std::string> exr_compressions{"none",  "rle", "zips", "zip",  "piz",
                                                "pxr24", "b44", "b44a", "dwaa", "dwab"};
const std::vector<std::string> tiff_compressions{"none", "lzw", "zip", "packbits"};

bool is_exr(const std::string& path) { return lower_extension(path) == ".exr"; }

bool is_tiff(const std::string& path) {
  return lower_extension(path) == ".tif" || lower_extension(path) == ".tiff";
}

bool is_jpeg(const std::string& path) {
  return lower_extension(path) == ".jpg" || lower_extension(path) == ".jpeg";
}

void write_display_encoded(const std::string& path, const PartInfo& part,
                           const std::vector<Plane>& colour, int bits,
                           std::vector<std::string>& notes) {
  std::size_t clipped = 0;
  for (const Plane& plane : colour) {
    clipped += static_cast<std::size_t>(
        std::count_if(plane.begin(), plane.end(), [](float v) { return !(v >= 0 && v <= 1); }));
  }
  if (clipped > 0) {
    notes.push_back(
        fmt::format("{} values outside 0...1 clipped by the {}-bit output", clipped, bits));
  }
  require_allowed_size(path + ": the display window", part.display.width, part.display.height);
  const LdrPicture picture{part.display.width,
                           part.display.height,
                           {},
                           to_display_window(colour, part.data, part.display),
                           bits};
  write_safely(path, [&](const std::string& name) { write_ldr(name, picture); });
}

/// Values that are finite, but not as the file's channel stores them.
std::size_t count_lost(const Plane& values, const Plane& stored) {
  return parallel_count(values.size(), [&](std::size_t i) {
    return std::isfinite(values[i]) && !std::isfinite(stored[i]);
  });
}

/// Grey with an alpha as R G B A: OpenCV writes no such PNG; a JPEG has no alpha.
std::vector<Plane> ldr_planes(const std::string& path, const std::vector<Plane>& colour) {
  if (colour.size() != 2) return colour;
  const Plane& grey = colour.front();
  if (is_jpeg(path)) return {grey};
  return {grey, grey, grey, colour.back()};
}

/// HDR holds R, G and B.
std::vector<int> hdr_channels(const std::vector<int>& channels) {
  if (channels.size() > 2) return {channels.begin(), channels.begin() + 3};
  return {channels.front(), channels.front(), channels.front()};
}

}  // namespace

std::vector<Plane> to_display_window(const std::vector<Plane>& planes, const Window& data,
                                     const Window& display) {
  if (data == display) return planes;
  const auto size = [](int pixels) { return static_cast<std::size_t>(pixels); };
  const int left = std::max(data.x, display.x);
  const int right = std::min(data.x + data.width, display.x + display.width);
  std::vector<Plane> out(planes.size(), Plane(size(display.width) * size(display.height)));
  for (int y = display.y; y < display.y + display.height; ++y) {
    if (y < data.y || y >= data.y + data.height || left >= right) continue;
    const std::size_t from = size(y - data.y) * size(data.width) + size(left - data.x);
    const std::size_t to = size(y - display.y) * size(display.width) + size(left - display.x);
    for (std::size_t c = 0; c < planes.size(); ++c) {
      std::copy_n(planes[c].data() + from, right - left, out[c].data() + to);
    }
  }
  return out;
}

void check_output_format(const std::string& path) {
  const std::vector<std::string> allowed{".exr", ".tif", ".tiff", ".hdr", ".png", ".jpg", ".jpeg"};
  const std::string e = lower_extension(path);
  for (const std::string& a : allowed) {
    if (e == a) return;
  }
  const std::string found = std::filesystem::is_directory(path) ? "is a folder"
                            : e.empty()                         ? "has no extension"
                                        : fmt::format("cannot write format '{}'", e);
  fail(ErrorKind::usage, "{}: {}; allowed are files with {}", path, found, join(allowed, " "));
}

void check_bits(const std::string& path, Bits bits) {
  require_named("bits", bits, Bits::single);
  if (bits == Bits::as_input) return;
  const bool is_float = bits == Bits::half || bits == Bits::single;
  const std::string allowed = is_exr(path)        ? "half float"
                              : is_tiff(path)     ? "8 16 float"
                              : is_jpeg(path)     ? "8"
                              : is_ldr_path(path) ? "8 16"
                                                  : "none: its format is fixed";
  const bool is_allowed = is_exr(path)        ? is_float
                          : is_tiff(path)     ? bits != Bits::half
                          : is_jpeg(path)     ? bits == Bits::eight
                          : is_ldr_path(path) ? !is_float
                                              : false;
  if (is_allowed) return;
  fail(ErrorKind::usage, "{}: its format has no such {}; allowed are {}", path, field("bits"),
       allowed);
}

void check_compression(const std::vector<std::string>& paths, const std::string& compression) {
  if (compression.empty()) return;
  bool is_of_use = false;
  for (const std::string& path : paths) {
    if (!is_exr(path) && !is_tiff(path)) continue;
    is_of_use = true;
    const std::vector<std::string>& known = is_exr(path) ? exr_compressions : tiff_compressions;
    if (std::find(known.begin(), known.end(), compression) != known.end()) continue;
    fail(ErrorKind::usage, "{}", not_known(path + ": " + field("compression"), compression, known));
  }
  if (is_of_use) return;
  fail(ErrorKind::usage, "{} goes with .exr and .tif, not with {}", field("compression"),
       paths.front());
}

bool keeps_other_channels(const std::string& path, const ImageFile& file) {
  const bool same_format = lower_extension(path) == lower_extension(file.path());
  return !is_ldr_path(path) && (same_format || (is_exr(path) && is_ldr_path(file.path())));
}

void write_picture(const std::string& path, ImageFile& file, const ColourChoice& choice,
                   const std::vector<Plane>& colour, Bits bits, std::vector<std::string>& notes) {
  const PartInfo& part = file.parts()[static_cast<std::size_t>(choice.part)];
  const bool keeps_all = keeps_other_channels(path, file);
  const bool has_more = file.parts().size() > 1 || part.channels.size() > choice.channels.size();
  if (has_more && !keeps_all) {
    notes.push_back("only colour is written: other channels stay behind in a change of format");
  }
  if (is_ldr_path(path)) {
    const bool is_deep = bits == Bits::sixteen ||
                         (bits == Bits::as_input && !is_jpeg(path) && part.integer_bits == 16);
    return write_display_encoded(path, part, ldr_planes(path, colour), is_deep ? 16 : 8, notes);
  }
  if (file.is_lossy()) {
    notes.push_back(
        "the file's compression is lossy: channels not rendered may change a little too");
  }
  if (file.has_smaller_levels()) {
    notes.push_back("is a texture: its largest MIP level alone is read and written");
  }
  if (keeps_all)
    file.set_bits(choice.part, is_tiff(path) ? std::vector<int>{} : choice.channels, bits);
  std::size_t overflowed = 0;
  for (std::size_t c = 0; c < colour.size(); ++c) {
    file.set_plane(choice.part, choice.channels[c], colour[c]);
    overflowed += count_lost(colour[c], file.plane(choice.part, choice.channels[c]));
  }
  if (overflowed > 0) {
    notes.push_back(
        fmt::format("{} values beyond half float's 65504 are written as Inf", overflowed));
  }
  write_safely(path, [&](const std::string& name) {
    if (keeps_all) return file.write(name);
    std::vector<int> channels = choice.channels;
    if (lower_extension(path) == ".hdr") channels = hdr_channels(channels);
    ImageFile alone = file.extract(choice.part, channels);
    // Of PNG and JPEG only 16 bits stay: 8 linear ones are too few.
    const bool is_deep = bits == Bits::as_input && is_tiff(path) && part.integer_bits == 16;
    alone.set_bits(0, {}, is_deep ? Bits::sixteen : bits);
    alone.write(name);
  });
}

void check_plane_format(const std::string& path, const std::string& name) {
  if (!is_exr(path) && !is_tiff(path)) {
    fail(ErrorKind::usage, "{}: {} is data, not colour; --{}-out takes .exr or .tif", path, name,
         name);
  }
}

void write_planes(const std::string& path, const std::vector<std::string>& names,
                  const ImageFile& like, int part, const std::vector<Plane>& planes) {
  check_plane_format(path, names.front());
  ImageFile file = like.extract(part, std::vector<int>(names.size()));
  for (std::size_t c = 0; c < names.size(); ++c) {
    file.rename_channel(0, static_cast<int>(c), names[c]);
    file.set_plane(0, static_cast<int>(c), planes[c]);
  }
  write_safely(path, [&](const std::string& temporary) { file.write(temporary); });
}

}  // namespace defray
