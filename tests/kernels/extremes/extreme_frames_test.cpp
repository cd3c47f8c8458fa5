// Frames and CoC at their limits through every method: kernel and twin give the same bits.
#include <cmath>
#include <limits>

#include "lens/lens_grid.h"
#include "methods/linear.h"
#include "methods/method.h"
#include "numbers.h"
#include "rdb/rdb.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::extreme_frames_test {
namespace {

constexpr int width = 1920;

/// A lens focused at 3 whose background's CoC has this radius.
Lens lens_of_background(double radius_px) {
  Lens lens;
  lens.focus_distance_units = 3;
  lens.aperture_diameter_mm *= radius_px / background_coc_px(lens, width);
  return lens;
}

/// Every method by name.
std::vector<std::pair<std::string, MethodSettings>> methods() {
  std::vector<std::pair<std::string, MethodSettings>> all(4);
  all[0].first = "rdb";
  all[1].first = "linear";
  all[1].second.method = Method::linear;
  all[2].first = "literal gather";
  all[3].first = "aware gather";
  for (const int i : {2, 3}) all[i].second.method = Method::gather;
  all[2].second.gather.kind = GatherKind::literal;
  for (auto& [name, settings] : all) {
    settings.rdb.cells_per_side = is_slow_device() ? 3 : 9;
    settings.gather.samples = is_slow_device() ? 8 : 32;
  }
  return all;
}

/// Renders with the kernels, and expects the twin's bits.
std::vector<Plane> render_both(const Frame& frame, const MethodSettings& settings) {
  auto kernel = apply_method(frame, settings, device()).colour;
  EXPECT_EQ(hash_of(kernel), hash_of(apply_method(frame, settings, twins()).colour));
  return kernel;
}

TEST(ExtremeFrames, CocFromAMillionthOfAPixelToAMillion) {
  const Size size{21, 13};
  const Plane depth = random_depth(size, 3);
  const std::vector<Plane> colour{random_plane(size, 4), random_plane(size, 5)};
  for (int exponent = -6; exponent <= 6; ++exponent) {
    const double radius_px = std::pow(10.0, exponent);
    const Lens lens = lens_of_background(radius_px);
    EXPECT_NEAR(device().coc(lens, width, {infinite})[0], 256 * radius_px,
                0.5 + 256 * radius_px * 0x1p-21);
    const auto coc = device().coc(lens, width, depth);
    for (const auto& method : methods()) {
      const MethodSettings& settings = method.second;
      SCOPED_TRACE(method.first + ", background CoC " + std::to_string(radius_px) + " px");
      const Frame frame{size.width, size.height, coc, depth, colour};
      if (settings.method == Method::linear && radius_px > linear_max_radius_px) {
        expect_error(ErrorKind::usage, {"1024"}, [&] { apply_method(frame, settings, device()); });
      } else if (settings.method != Method::linear || radius_px <= (is_slow_device() ? 1 : 10)) {
        const auto out = render_both(frame, settings);
        // Depth 1.2 has twice the background's: all below half a quantum is a bit-exact copy.
        if (2 * radius_px < 1.0 / 512) {
          EXPECT_EQ(hash_of(out), hash_of(colour));
        }
      }
    }
  }
}

TEST(ExtremeFrames, OneDepthIsAShiftByEachCell) {
  // With one CoC for all, cell k of pixel x holds pixel x - round(r u_k), if that is in the frame.
  const Size size{37, 19};
  const Plane depth(37 * 19, 5.0f), colour = random_plane(size, 6);
  for (const std::int32_t quanta : {-2600, -300, 100, 128, 999, 4000}) {
    const std::vector<std::int32_t> coc(depth.size(), quanta);
    for (const auto& [name, settings] : methods()) {
      SCOPED_TRACE(name + ", " + std::to_string(quanta));
      if (settings.method == Method::linear && is_slow_device() && quanta > 1000) continue;
      const Plane out = render_both({37, 19, coc, depth, {colour}}, settings)[0];
      if (settings.method != Method::rdb) continue;
      const auto cells = make_lens_grid(settings.rdb.cells_per_side, false).points;
      for (int x = 0; x < 37 * 19; ++x) {
        double sum = 0, largest_colour = 0;
        int count = 0;
        for (const auto& [u, v] : cells) {
          // x - p - r u in [-1/2, 1/2): p is the whole number in (x - r u - 1/2, x - r u + 1/2].
          const auto source = [&](int at, std::int32_t lens) {
            return static_cast<int>(std::floor(at - std::ldexp(double(quanta) * lens, -24) + 0.5));
          };
          const int sx = source(x % 37, u), sy = source(x / 37, v);
          if (sx < 0 || sx >= 37 || sy < 0 || sy >= 19) continue;
          const double c = colour[static_cast<std::size_t>(sy * 37 + sx)];
          sum += c, ++count;
          largest_colour = std::fmax(largest_colour, std::fabs(c));
        }
        const double mean = count > 0 ? sum / count : colour[x];
        ASSERT_NEAR(out[x], mean, (2.0 * count + 7) * largest_colour * 0x1p-24) << "pixel " << x;
      }
    }
  }
}

TEST(ExtremeFrames, CheckerboardDepth) {
  for (const Size size : {Size{1, 1}, {1, 23}, {23, 1}, {31, 17}}) {
    Plane depth;
    for (int i = 0; i < size.width * size.height; ++i) {
      const bool is_near = (i % size.width + i / size.width) % 2 == 0;
      depth.push_back(is_near ? 1e-6f : infinite);
    }
    const std::vector<Plane> colour{random_plane(size, 7)};
    for (const double limit_px : {0.4, 3.0, 12.0}) {
      Lens lens = lens_of_background(limit_px);
      lens.max_coc_px = limit_px;
      const auto coc = device().coc(lens, width, depth);
      EXPECT_EQ(coc, twins().coc(lens, width, depth));
      EXPECT_EQ(coc[0], -std::lround(256 * limit_px));
      for (const auto& [name, settings] : methods()) {
        if (settings.method == Method::linear && is_slow_device() && limit_px > 1) continue;
        SCOPED_TRACE(name);
        render_both({size.width, size.height, coc, depth, colour}, settings);
      }
    }
  }
}

TEST(ExtremeFrames, OneCellIsThePinholePicture) {
  for (const Size size : awkward_sizes()) {
    if (is_slow_device() && size.width > 100) continue;
    const std::vector<Plane> colour{random_plane(size, 8)};
    for (const double radius : {0.0, 7.0, 4194303.0}) {
      const Frame frame{size.width, size.height, random_coc(size, radius, 9),
                        random_depth(size, 10), colour};
      const auto out = device().rays(frame, plan_rays({1})).means;
      EXPECT_EQ(hash_of(out), hash_of(colour)) << size.width << "x" << size.height;
    }
  }
}

}  // namespace
}  // namespace defray::test::extreme_frames_test
