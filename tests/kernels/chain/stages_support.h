#pragma once
// What the tests of the stages before the RDB share: a frame to draw on.
#include <functional>
#include <vector>

#include "frame/backend.h"
#include "support.h"

namespace defray::test {

/// One layer of a frame by itself.
inline Frame layer_of(const Frame& f, int layer) {
  Frame one = f.without_planes();
  one.layers = 1;
  const auto picked = [&]<typename T>(const Values<T>& plane) {
    std::vector<T> values;
    for (std::size_t i = 0; i < f.pixels(); ++i) {
      values.push_back(plane[f.front_of(i) + size(layer) * size(f.width)]);
    }
    return Values<T>(std::move(values));
  };
  one.coc_quanta = picked(f.coc_quanta);
  one.depth = picked(f.depth);
  one.coverage = picked(f.coverage);
  for (const Values<float>& channel : f.channels) one.channels.push_back(picked(channel));
  return one;
}

/// What `split` gives, layer by layer.
struct Parted {
  Frame front, behind;
  explicit Parted(const Frame& layers) : front(layer_of(layers, 0)), behind(layer_of(layers, 1)) {}
};

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
  Parted parted() const { return Parted(device().split(view(), mixed(), filled())); }

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
