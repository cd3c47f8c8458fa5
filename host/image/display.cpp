#include "image/display.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "image/ldr.h"
#include "image/mat.h"
#include "image/safe_output.h"

namespace defray {
namespace {

constexpr int caption_height = 36;
constexpr int gap = 8;

/// A local X server listens on this socket. Toolkits end the process where it does not.
bool x_server_answers(const std::string& socket_path) {
  const int s = socket(AF_UNIX, SOCK_STREAM, 0);
  if (s < 0) return false;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket_path.c_str(), sizeof(address.sun_path) - 1);
  const bool ok = connect(s, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(s);
  return ok;
}

}  // namespace

cv::Mat to_mat(const std::vector<Plane>& planes, int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x);
      for (int c = 0; c < 3; ++c) {
        const double linear = static_cast<double>(planes[static_cast<std::size_t>(2 - c)][at]);
        const double encoded = 255 * srgb_encode(std::clamp(linear, 0.0, 1.0));
        image.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(std::lround(encoded));
      }
    }
  }
  return image;
}

void write_sheet(const std::string& path, const std::vector<SheetPanel>& panels, int width,
                 int height) {
  const int count = static_cast<int>(panels.size());
  cv::Mat sheet(height + caption_height, count * (width + gap) - gap, CV_8UC3,
                cv::Scalar::all(255));
  for (int i = 0; i < count; ++i) {
    const SheetPanel& panel = panels[static_cast<std::size_t>(i)];
    const int left = i * (width + gap);
    to_mat(panel.planes, width, height)
        .copyTo(sheet(cv::Rect(left, caption_height, width, height)));
    cv::putText(sheet, panel.caption, {left + 4, caption_height - 12}, cv::FONT_HERSHEY_SIMPLEX,
                0.6, cv::Scalar::all(0), 1, cv::LINE_AA);
  }
  write_safely(path, [&](const std::string& name) { write_encoded(name, &sheet); });
}

bool has_display(std::string& why) {
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  const char* x11 = std::getenv("DISPLAY");
  if (wayland && *wayland) return true;
  if (!x11 || !*x11) {
    why = "neither DISPLAY nor WAYLAND_DISPLAY is set";
    return false;
  }
  const std::string name = x11;
  if (name[0] != ':') return true;  // a remote display: the toolkit finds out
  const std::string number = name.substr(1, name.find('.') - 1);
  if (x_server_answers("/tmp/.X11-unix/X" + number)) return true;
  why = "DISPLAY is " + name + ", but no X server answers there";
  return false;
}

}  // namespace defray
