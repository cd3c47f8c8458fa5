// What every method must do: leave sharp pictures alone, keep light where it is.
#include "method.h"

#include <cmath>

#include "support.h"

namespace defray::test {
namespace {

/// Every method and kind, with a name for messages.
std::vector<std::pair<std::string, MethodSettings>> all_methods() {
  std::vector<std::pair<std::string, MethodSettings>> all;
  const auto add = [&](const std::string& name, Method method, GatherKind kind, bool rotate) {
    MethodSettings s;
    s.method = method;
    s.rdb.jitter = rotate;
    s.gather.kind = kind;
    s.gather.rotate = rotate;
    all.emplace_back(name + (rotate ? ", randomised" : ""), s);
  };
  add("linear", Method::linear, {}, false);
  for (const bool rotate : {false, true}) {
    add("rdb", Method::rdb, {}, rotate);
    add("literal gather", Method::gather, GatherKind::literal, rotate);
    add("aware gather", Method::gather, GatherKind::aware, rotate);
  }
  return all;
}

TEST(Method, ClosedApertureReturnsTheInputBitForBit) {
  const Size size{37, 23};
  const Plane depth = random_depth(size, 1);
  const std::vector<std::int32_t> coc(depth.size());
  std::vector<Plane> colour;
  for (std::uint32_t c = 0; c < 3; ++c) colour.push_back(random_plane(size, c));
  for (const auto& [name, settings] : all_methods()) {
    for (Session* s : {&session(), static_cast<Session*>(nullptr)}) {
      EXPECT_EQ(hash_of(apply_method({37, 23, coc, depth, colour}, settings, s)), hash_of(colour))
          << name << (s ? "" : ", twin");
    }
  }
}

TEST(Method, ImpulsesKeepTheirCentroid) {
  constexpr int side = 61, middle = 30;
  for (const double radius : {0.6, 2.3, 11.0}) {
    const Plane depth(side * side, 4.0f);
    const std::vector<std::int32_t> coc(depth.size(), std::lround(256 * radius));
    Plane impulse(depth.size());
    impulse[middle * side + middle] = 100;
    for (const auto& [name, settings] : all_methods()) {
      // Turned or shifted samples differ from pixel to pixel: their noise moves a single impulse.
      if (name.find("random") != std::string::npos) continue;
      const Plane out = apply_method({side, side, coc, depth, {impulse}}, settings, &session())[0];
      double sum = 0, x = 0, y = 0;
      for (int i = 0; i < side * side; ++i) {
        sum += out[i], x += out[i] * (i % side - middle), y += out[i] * (i / side - middle);
      }
      ASSERT_GT(sum, 0) << name;
      EXPECT_NEAR(x / sum, 0, 0.01) << name << ", radius " << radius;
      EXPECT_NEAR(y / sum, 0, 0.01) << name << ", radius " << radius;
    }
  }
}

TEST(Method, TwinsGiveTheSamePicture) {
  const Size size{53, 29};
  const Plane depth = random_depth(size, 1);
  const auto coc = random_coc(size, 4, 2);
  const std::vector<Plane> colour{random_plane(size, 3)};
  for (const auto& [name, settings] : all_methods()) {
    const PinholeFrame frame{53, 29, coc, depth, colour};
    const Plane kernel = apply_method(frame, settings, &session())[0];
    const Plane twin = apply_method(frame, settings, nullptr)[0];
    // Only the RDB's twin works in double; its bound is in rdb_test.
    const double tolerance = settings.method == Method::rdb ? 64 * 150 * 0x1p-24 : 0;
    for (std::size_t i = 0; i < twin.size(); ++i)
      ASSERT_NEAR(kernel[i], twin[i], tolerance) << name;
  }
}

}  // namespace
}  // namespace defray::test
