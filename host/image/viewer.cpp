#include "image/viewer.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "base/srgb.h"
#include "image/mat.h"
#include "image/viewer_qt.h"

namespace defray {
namespace {

constexpr int largest_width = 1600, largest_height = 900;
constexpr int poll_ms = 30;

/// Where a picture lies in a window.
struct Placement {
  double scale = 1, left = 0, top = 0;
};

Placement place(const cv::Size& picture, const cv::Size& window, bool is_actual_size) {
  Placement p;
  if (!is_actual_size) {
    p.scale = std::min(static_cast<double>(window.width) / picture.width,
                       static_cast<double>(window.height) / picture.height);
  }
  p.left = std::floor((window.width - p.scale * picture.width) / 2);
  p.top = std::floor((window.height - p.scale * picture.height) / 2);
  return p;
}

int letter_or_key(int code) {
  // GTK's and Qt's codes of the arrows are those of X.
  switch (code & 0xffff) {
    case 0xff51:
      return key_left;
    case 0xff52:
      return key_up;
    case 0xff53:
      return key_right;
    case 0xff54:
      return key_down;
    default:
      return code & 0xff;
  }
}

}  // namespace

struct Viewer::State {
  std::string title;
  cv::Mat picture, shown;
  bool is_actual_size = false;
  Placement placement;
  std::deque<ViewerEvent> events;
  std::optional<QtViews> qt_views;

  void draw(const cv::Size& window) {
    placement = place(picture.size(), window, is_actual_size);
    const cv::Matx23d to_window(placement.scale, 0, placement.left, 0, placement.scale,
                                placement.top);
    cv::Mat scaled = picture;
    if (!is_actual_size) {
      const cv::Size size(
          std::max(1, static_cast<int>(std::lround(picture.cols * placement.scale))),
          std::max(1, static_cast<int>(std::lround(picture.rows * placement.scale))));
      cv::resize(picture, scaled, size, 0, 0,
                 placement.scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    }
    shown = cv::Mat(window, CV_8UC3, cv::Scalar::all(48));
    const cv::Rect all(cv::Point(), window);
    const cv::Rect there(
        cv::Point(static_cast<int>(placement.left), static_cast<int>(placement.top)),
        scaled.size());
    const cv::Rect seen = all & there;
    if (!seen.empty()) scaled(seen - there.tl()).copyTo(shown(seen));
    cv::imshow(title, shown);
  }

  static void on_mouse(int event, int x, int y, int flags, void* data) {
    State& s = *static_cast<State*>(data);
    ViewerEvent e;
    if (event == cv::EVENT_LBUTTONDOWN) {
      e.kind = ViewerEvent::Kind::click;
      e.x = static_cast<int>(std::floor((x - s.placement.left) / s.placement.scale));
      e.y = static_cast<int>(std::floor((y - s.placement.top) / s.placement.scale));
      if (e.x >= 0 && e.y >= 0 && e.x < s.picture.cols && e.y < s.picture.rows) {
        s.events.push_back(e);
      }
    } else if (event == cv::EVENT_MOUSEWHEEL) {
      s.on_wheel(cv::getMouseWheelDelta(flags) > 0 ? 1 : -1, (flags & cv::EVENT_FLAG_CTRLKEY) != 0);
    }
  }

  void on_wheel(int steps, bool has_control) {
    ViewerEvent e;
    e.kind = ViewerEvent::Kind::wheel;
    e.steps = steps;
    e.has_control = has_control;
    events.push_back(e);
  }
};

Viewer::Viewer(const std::string& title, int width, int height)
    : state_(std::make_unique<State>()) {
  state_->title = title;
  // Without the toolbar and the status line that Qt would put around the picture.
  cv::namedWindow(
      title, static_cast<int>(cv::WINDOW_NORMAL) | cv::WINDOW_FREERATIO | cv::WINDOW_GUI_NORMAL);
  const double scale = std::min({1.0, static_cast<double>(largest_width) / width,
                                 static_cast<double>(largest_height) / height});
  cv::resizeWindow(title, std::max(64, static_cast<int>(width * scale)),
                   std::max(64, static_cast<int>(height * scale)));
  cv::setMouseCallback(title, State::on_mouse, state_.get());
  state_->qt_views.emplace(
      [s = state_.get()](int steps, bool has_control) { s->on_wheel(steps, has_control); });
}

Viewer::~Viewer() { cv::destroyWindow(state_->title); }

void Viewer::show(const std::vector<Plane>& planes, int width, int height, bool is_actual_size,
                  const std::string& status) {
  state_->picture = to_mat(planes, width, height);
  state_->is_actual_size = is_actual_size;
  const cv::Rect area = cv::getWindowImageRect(state_->title);
  state_->draw(area.width > 1 && area.height > 1 ? area.size() : state_->picture.size());
  cv::setWindowTitle(state_->title, status);
}

ViewerEvent Viewer::wait() {
  State& s = *state_;
  while (s.events.empty()) {
    const int code = cv::waitKeyEx(poll_ms);
    ViewerEvent e;
    if (code >= 0) {
      e.kind = ViewerEvent::Kind::key;
      e.key = letter_or_key(code);
      return e;
    }
    if (cv::getWindowProperty(s.title, cv::WND_PROP_VISIBLE) < 1) return e;
    const cv::Rect area = cv::getWindowImageRect(s.title);
    if (area.width > 1 && area.height > 1 && area.size() != s.shown.size()) s.draw(area.size());
  }
  const ViewerEvent e = s.events.front();
  s.events.pop_front();
  return e;
}

}  // namespace defray
