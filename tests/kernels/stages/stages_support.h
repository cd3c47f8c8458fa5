#pragma once
// What the tests of the stages before the RDB share: a frame to draw on.
#include <functional>
#include <vector>

#include "frame/backend.h"
#include "support.h"

namespace defray::test {

/// A frame to draw on: a plane 6 px of CoC behind the focus, 1/depth 0.2, black.
struct Canvas {
  int width, height;
  std::vector<std::int32_t> coc;
  Plane inverse;
  std::vector<Plane> channels;

  Canvas(int w, int h) : width(w), height(h), coc(count(), 1536), inverse(count(), 0.2f) {
    channels.assign(4, Plane(count()));
    channels[3].assign(count(), 1.0f);
  }
  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
  Frame view() const {
    Frame f{width, height, coc, {}, channels};
    f.inverse = inverse;
    return f;
  }
  Words mixed() const { return device().mixed(view()); }
  Frame filled() const { return device().fill(view(), mixed(), DEFRAY_FILL_DIRECTIONS); }
  Surfaces parted() const { return device().split(view(), mixed(), filled()); }

  void paint(int x, int y, float r, float g, float b) {
    channels[0][at(x, y)] = r;
    channels[1][at(x, y)] = g;
    channels[2][at(x, y)] = b;
  }
  void each(const std::function<void(int, int)>& visit) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) visit(x, y);
    }
  }
  /// A bar from column x0 up to x1, 1/depth 0.5, in focus unless said otherwise.
  void add_bar(int x0, int x1, std::int32_t bar_coc = 0) {
    for (int y = 0; y < height; ++y) {
      for (int x = x0; x < x1; ++x) {
        coc[at(x, y)] = bar_coc;
        inverse[at(x, y)] = 0.5f;
      }
    }
  }
};

/// Bits, so that NaN equals itself and -0 is not 0.
inline void expect_same_bits(const Values<float>& a, const Values<float>& b) {
  EXPECT_EQ(hash_of_planes({a}), hash_of_planes({b}));
}

}  // namespace defray::test
