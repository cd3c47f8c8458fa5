#include "lens/aperture_picture.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/channels.h"
#include "image/image_file.h"

namespace defray {
namespace {

struct Luminance {
  int width = 0, height = 0;
  std::vector<double> values;

  double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// The channels to look at: R G B (A), or the file's only one. Throws Error(input).
ColourChoice choose_light(const ImageFile& file) {
  const bool is_grey = file.parts().size() == 1 && file.parts()[0].channels.size() == 1;
  if (is_grey) return {0, "", "", {0}};
  return choose_colour(file.path(), file.parts(), {});
}

/// Of the data window, row by row. Alpha is premultiplied already.
std::vector<double> stored_luminance(const ImageFile& file, const ColourChoice& choice) {
  const std::vector<double> weights = choice.channels.size() == 1
                                          ? std::vector<double>{1}
                                          : std::vector<double>{0.2126, 0.7152, 0.0722};
  std::vector<double> sum;
  for (std::size_t c = 0; c < weights.size(); ++c) {
    const Plane plane = file.plane(choice.part, choice.channels[c]);
    sum.resize(plane.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += weights[c] * static_cast<double>(plane[i]);
    }
  }
  return sum;
}

/// Of the display window; no light where nothing is stored.
Luminance read_luminance(const std::string& path) {
  const ImageFile file = ImageFile::read(path);
  const ColourChoice choice = choose_light(file);
  const PartInfo& part = file.parts()[static_cast<std::size_t>(choice.part)];
  const Window data = part.data, display = part.display;
  const std::vector<double> stored = stored_luminance(file, choice);
  Luminance light{display.width, display.height, {}};
  light.values.resize(static_cast<std::size_t>(light.width) *
                      static_cast<std::size_t>(light.height));
  std::size_t i = 0;
  for (int y = data.y - display.y; y < data.y - display.y + data.height; ++y) {
    for (int x = data.x - display.x; x < data.x - display.x + data.width; ++x, ++i) {
      if (!std::isfinite(stored[i])) {
        fail(ErrorKind::input, "{}: holds NaN or Inf at pixel {},{}: no aperture", path, x, y);
      }
      if (stored[i] < 0) {
        fail(ErrorKind::input, "{}: {:.3g} at pixel {},{}: an aperture lets 0 or more light pass",
             path, stored[i], x, y);
      }
      const bool is_shown = x >= 0 && y >= 0 && x < light.width && y < light.height;
      if (is_shown) light.at(x, y) = stored[i];
    }
  }
  return light;
}

/// Pixels [first, first + shares.size()) under a texel, each with the part of it, in pixels.
struct Footprint {
  int first = 0;
  std::vector<double> shares;
};

/// Of each texel along one axis on which the picture's `pixels` span the middle `extent` (0...1) of
/// the mask.
std::vector<Footprint> footprints(int pixels, double extent) {
  std::vector<Footprint> all;
  for (int t = 0; t < ApertureMask::side; ++t) {
    const auto pixel_at = [&](int edge) {
      const double from_middle = (static_cast<double>(edge) / ApertureMask::side - 0.5) / extent;
      return std::clamp((from_middle + 0.5) * pixels, 0.0, static_cast<double>(pixels));
    };
    const double begin = pixel_at(t), end = pixel_at(t + 1);
    Footprint footprint{static_cast<int>(begin), {}};
    for (int p = footprint.first; p < end; ++p) {
      footprint.shares.push_back(std::min(p + 1.0, end) - std::max<double>(p, begin));
    }
    all.push_back(footprint);
  }
  return all;
}

double light_under(Luminance& light, const Footprint& columns, const Footprint& rows) {
  double sum = 0;
  for (std::size_t j = 0; j < rows.shares.size(); ++j) {
    for (std::size_t i = 0; i < columns.shares.size(); ++i) {
      const int x = columns.first + static_cast<int>(i), y = rows.first + static_cast<int>(j);
      sum += rows.shares[j] * columns.shares[i] * light.at(x, y);
    }
  }
  return sum;
}

}  // namespace

ApertureMask rasterise_picture(const Aperture& aperture) {
  Luminance light = read_luminance(aperture.image);
  const double height_over_width = aperture.squeeze * light.height / light.width;
  const auto columns = footprints(light.width, std::min(1.0, 1 / height_over_width));
  const auto rows = footprints(light.height, std::min(1.0, height_over_width));
  std::vector<double> sums;
  for (const Footprint& row : rows) {
    for (const Footprint& column : columns) sums.push_back(light_under(light, column, row));
  }
  const double most = *std::max_element(sums.begin(), sums.end());
  if (!(most > 0)) {
    fail(ErrorKind::input, "{}: is black: an aperture must let light through", aperture.image);
  }
  ApertureMask mask;
  for (const double sum : sums) {
    mask.coverage.push_back(static_cast<std::uint8_t>(std::lround(255 * (sum / most))));
  }
  return mask;
}

}  // namespace defray
