#pragma once
// An image file in memory: every part and channel in its own type, so that what defray does not
// touch is written back bit for bit. The only header that the OpenImageIO code shows to the rest.
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/plane.h"
#include "base/window.h"
#include "defray/options.h"
#include "image/ldr.h"

namespace defray {

struct PartInfo {
  std::string name;
  std::string view;                ///< The part's own view, empty where it has none.
  std::vector<std::string> views;  ///< multiView of a single-part stereo file, default view first.
  std::vector<std::string> channels;
  Window data;           ///< Data window: the pixels that are stored.
  Window display;        ///< Display window: the picture's frame.
  int integer_bits = 0;  ///< Bits of a channel stored as a whole number; 0: floats.
};

using Matrix4 = std::array<float, 16>;

enum class Sample { half_float, single_float };

class ImageFile {
 public:
  /// Reads every part of a file. PNG and JPEG pictures are decoded from sRGB to linear; as data
  /// their numbers are taken as stored, 0...1.
  /// Throws Error(input) naming the file: missing, unreadable, truncated, deep, absurd size.
  static ImageFile read(const std::string& path, Content content = Content::picture);

  /// A single-part image with these channels, stored as half or 32-bit floats.
  static ImageFile from_planes(const std::vector<std::string>& channels,
                               const std::vector<Plane>& planes, int width, int height,
                               Sample sample = Sample::half_float);

  ImageFile(ImageFile&&) noexcept;
  ImageFile& operator=(ImageFile&&) noexcept;
  ~ImageFile();

  const std::string& path() const { return path_; }
  const std::vector<PartInfo>& parts() const { return info_; }

  Plane plane(int part, int channel) const;
  void set_plane(int part, int channel, const Plane& plane);

  /// Whether a channel is stored as 32-bit whole numbers: ids, which no float holds.
  bool holds_integers(int part, int channel) const;

  /// Gives each pixel of a channel the value that pixel `from` has in it, bit for bit.
  void move_values(int part, int channel, const std::vector<std::uint32_t>& from);

  void rename_channel(int part, int channel, const std::string& name);

  /// A number among the metadata of any part, whatever type it was stored in (text included).
  std::optional<double> metadata_number(const std::string& name) const;

  /// A 4x4 matrix among them, row by row: it stands behind row vectors.
  std::optional<Matrix4> metadata_matrix(const std::string& name) const;

  /// Any of them as text.
  std::optional<std::string> metadata_text(const std::string& name) const;

  /// Its name as the file spells it; names are alike whatever their case.
  std::optional<std::string> metadata_name(const std::string& name) const;

  /// True where writing with the file's own compression (DWA, B44, PXR24, JPEG in TIFF) changes
  /// values.
  bool is_lossy() const;

  /// Of a texture: its MIP levels but the largest are not read.
  bool has_smaller_levels() const;

  /// Gives a part this data window, which holds its own: 0 where nothing was.
  void grow(int part, const Window& data);

  /// How these channels, or all where none is named, are stored from now on.
  void set_bits(int part, const std::vector<int>& channels, Bits bits);

  /// Of all parts, as OpenImageIO names it.
  void set_compression(const std::string& name);

  /// Writes all parts with their windows, metadata, types and compression where the format of
  /// `path` is the one that was read; throws Error(output) otherwise or when writing fails.
  void write(const std::string& path) const;

  /// One part with only these channels, as float where the format can, metadata kept.
  ImageFile extract(int part, const std::vector<int>& channels) const;

 private:
  struct Part;
  ImageFile();
  static ImageFile read_linear_file(const std::string& path);
  void refresh_info();

  std::string path_;
  int encoded_bits_ = 0;  ///< Of a PNG or JPEG, whose values are kept as floats.
  std::vector<PartInfo> info_;
  std::vector<Part> parts_;
};

}  // namespace defray
