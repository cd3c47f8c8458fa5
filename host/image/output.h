#pragma once
// Rendered frames to files of any of the formats that defray writes.
#include <cstdint>
#include <string>
#include <vector>

#include "image/channels.h"
#include "image/image_file.h"

namespace defray {

/// Throws Error(usage) unless the extension of `path` is one that defray writes.
void check_output_format(const std::string& path);

/// Throws Error(usage) unless those of the files that are EXR or TIFF, one at least, can be
/// compressed so. Empty: as the input is.
void check_compression(const std::vector<std::string>& paths, const std::string& compression);

/// What the display window shows: planes cropped to it, black where there is no data.
std::vector<Plane> to_display_window(const std::vector<Plane>& planes, const Window& data,
                                     const Window& display);

/// Whether `path` can be written with all that `file` has, and not only its colour.
bool keeps_other_channels(const std::string& path, const ImageFile& file);

/// Throws Error(usage) unless the format of `path` can have so many bits.
void check_bits(const std::string& path, Bits bits);

/// Puts `colour` in place of the chosen channels of `file` and writes it. The input's own format
/// keeps everything; another one keeps what it can hold, and `notes` says what was left out.
/// PNG and JPEG get the display window; PNG and TIFF 16 bits where the input has those.
void write_picture(const std::string& path, ImageFile& file, const ColourChoice& choice,
                   const std::vector<Plane>& colour, Bits bits, std::vector<std::string>& notes);

/// Throws Error(usage) unless `path` can hold the data `name`.
void check_plane_format(const std::string& path, const std::string& name);

/// Writes planes of values as float channels of these names, with the windows and metadata of
/// `part` of `like`: signed CoC radii in pixels as "coc", "confidence".
void write_planes(const std::string& path, const std::vector<std::string>& names,
                  const ImageFile& like, int part, const std::vector<Plane>& planes);
inline void write_plane(const std::string& path, const std::string& name, const ImageFile& like,
                        int part, const Plane& values) {
  write_planes(path, {name}, like, part, {values});
}

}  // namespace defray
