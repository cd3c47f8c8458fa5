#pragma once
// A window with a picture, and what its user does there. OpenCV only.
#include <memory>
#include <string>
#include <vector>

#include "base/plane.h"

namespace defray {

/// What happened in a window.
struct ViewerEvent {
  enum class Kind { key, click, wheel, closed };
  Kind kind = Kind::closed;
  int key = 0;               ///< A letter, or one of Key.
  int x = 0, y = 0;          ///< Of a click, the picture's pixel.
  int steps = 0;             ///< Of a wheel, up is above 0.
  bool has_control = false;  ///< Of a wheel, with the Control key.
};

/// Keys that are no letters.
enum Key { key_escape = 27, key_left = 0x10001, key_up, key_right, key_down };

class Viewer {
 public:
  /// Opens a window, no larger than a usual screen, for pictures of this size.
  Viewer(const std::string& title, int width, int height);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Shows linear R G B, sRGB-encoded, fitted to the window or, by `is_actual_size`, a pixel for a
  /// pixel about its middle; anew whenever the window changes its size. `status` is its title.
  void show(const std::vector<Plane>& planes, int width, int height, bool is_actual_size,
            const std::string& status);

  /// Waits for the next event.
  ViewerEvent wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace defray
