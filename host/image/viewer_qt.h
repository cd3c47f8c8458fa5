#pragma once
// What OpenCV's windows do by themselves where they are Qt's.
#include <functional>
#include <memory>

namespace defray {

/// Takes keys and wheel from the views of OpenCV's Qt windows as long as it lives: after a click,
/// a view keeps the arrows, to scroll, and the wheel enlarges it, whatever the window's flags
/// (highgui has no call for either; OpenCV issue 11500). Does nothing where OpenCV's windows are
/// another toolkit's, or where defray was built without Qt.
class QtViews {
 public:
  /// `on_wheel`: steps, above 0 up, and whether Control was held. For the windows that are open.
  explicit QtViews(std::function<void(int, bool)> on_wheel);
  ~QtViews();
  QtViews(const QtViews&) = delete;
  QtViews& operator=(const QtViews&) = delete;

 private:
  struct Filter;
  std::unique_ptr<Filter> filter_;
};

}  // namespace defray
