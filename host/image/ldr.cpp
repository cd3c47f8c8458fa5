#include "image/ldr.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

/// OpenCV stores B G R A.
int bgr_index(std::size_t channel) {
  return channel < 3 ? 2 - static_cast<int>(channel) : static_cast<int>(channel);
}

double stored_value(const cv::Mat& image, int y, int x, int channel) {
  const int at = x * image.channels() + channel;
  if (image.depth() == CV_16U) return image.ptr<std::uint16_t>(y)[at] / 65535.0;
  return image.ptr<std::uint8_t>(y)[at] / 255.0;
}

/// Of 8 or 16 bits, by the image's type.
void store_value(cv::Mat& image, int y, int x, int channel, double encoded) {
  const int at = x * image.channels() + channel;
  const double value = std::clamp(encoded, 0.0, 1.0);
  if (image.depth() == CV_16U) {
    image.ptr<std::uint16_t>(y)[at] = static_cast<std::uint16_t>(std::lround(65535 * value));
  } else {
    image.ptr<std::uint8_t>(y)[at] = static_cast<std::uint8_t>(std::lround(255 * value));
  }
}

}  // namespace

bool is_ldr_path(const std::string& path) {
  const std::string e = lower_extension(path);
  return e == ".png" || e == ".jpg" || e == ".jpeg";
}

LdrPicture read_ldr(const std::string& path, Content content) {
  cv::Mat image;
  try {
    image = cv::imread(path, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    fail(ErrorKind::input, "{}: not a readable image: {}", path, error.err);
  }
  if (image.empty())
    fail(ErrorKind::input, "{}: not a readable image (damaged or truncated)", path);
  if (image.depth() != CV_8U && image.depth() != CV_16U) {
    fail(ErrorKind::input, "{}: neither 8 nor 16 bits a channel", path);
  }
  LdrPicture picture;
  picture.bits = image.depth() == CV_16U ? 16 : 8;
  picture.width = image.cols;
  picture.height = image.rows;
  const bool is_data = content == Content::data;
  picture.channels = {"R", "G", "B"};
  if (image.channels() == 1) picture.channels = {"Y"};
  const bool has_alpha = image.channels() == 4;
  if (has_alpha) picture.channels.push_back("A");
  picture.planes.assign(picture.channels.size(), Plane(image.total()));
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols) +
                             static_cast<std::size_t>(x);
      const double alpha = has_alpha ? stored_value(image, y, x, 3) : 1;
      for (std::size_t c = 0; c < std::min<std::size_t>(3, picture.planes.size()); ++c) {
        const int stored = image.channels() == 1 ? 0 : bgr_index(c);
        const double value = stored_value(image, y, x, stored);
        picture.planes[c][at] = static_cast<float>(is_data ? value : alpha * srgb_decode(value));
      }
      if (has_alpha) picture.planes[3][at] = static_cast<float>(alpha);
    }
  }
  return picture;
}

void write_ldr(const std::string& path, const LdrPicture& picture) {
  const bool has_alpha = picture.planes.size() == 4;
  const bool keeps_alpha = has_alpha && lower_extension(path) == ".png";
  const std::size_t colours = picture.planes.size() == 1 ? 1 : 3;
  const int channels = static_cast<int>(colours) + keeps_alpha;
  cv::Mat image(picture.height, picture.width,
                CV_MAKETYPE(picture.bits == 16 ? CV_16U : CV_8U, channels));
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x);
      const double alpha = keeps_alpha ? static_cast<double>(picture.planes[3][at]) : 1;
      for (std::size_t c = 0; c < colours; ++c) {
        const double colour = static_cast<double>(picture.planes[c][at]);
        // PNG stores unassociated alpha; a transparent pixel has no colour to recover.
        const double straight = alpha > 0 ? colour / alpha : 0;
        store_value(image, y, x, colours == 1 ? 0 : bgr_index(c), srgb_encode(straight));
      }
      if (keeps_alpha) store_value(image, y, x, 3, alpha);
    }
  }
  write_encoded(path, &image);
}

void write_encoded(const std::string& path, const void* mat) {
  // Encoded in memory and written by us: the codecs report a full disk on their own, or not at all.
  const cv::Mat& image = *static_cast<const cv::Mat*>(mat);
  std::vector<std::uint8_t> bytes;
  try {
    cv::imencode(lower_extension(path), image, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  } catch (const cv::Exception& error) {
    fail(ErrorKind::output, "{}: cannot encode {}x{} pixels: {}", path, image.cols, image.rows,
         error.err);
  }
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) fail(ErrorKind::output, "{}: cannot write: {}", path, std::strerror(errno));
}

}  // namespace defray
