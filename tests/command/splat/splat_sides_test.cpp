// Surfaces seen from outside, from behind and from within, by defray splat.
#include <cmath>
#include <fstream>
#include <numeric>

#include "command/splat/splat_command.h"
#include "image/image_file.h"

namespace defray::test::splat_sides_test {
namespace {
using nlohmann::json;
using splat_command_test::SplatCommand;
using splat_command_test::wide_lens;

TEST_F(SplatCommand, WhatIsSeenFromBehindIsNoted) {
  const std::string inside = "splat plane.xyz -o o.exr --size 32x32 " + wide_lens;
  std::ofstream points(folder_ / "plane.xyz");
  points << "x y z nx ny nz\n";
  for (int i = 0; i < 400; ++i) points << i % 20 << ' ' << i / 20 << " 0 0 0 -1\n";
  points.close();
  const Result result = defray(folder_, inside);
  expect_ok(result);
  EXPECT_NE(result.out.find("  note: 100 % of what is before the camera is seen from behind"),
            std::string::npos)
      << result.out;
  EXPECT_EQ(defray(folder_, inside + "--two-sided").out.find("behind"), std::string::npos);
  EXPECT_EQ(defray(folder_, inside + "-q").out, "");
  const json report = render(wide_lens);
  EXPECT_GT(report["from_behind"], 0.2);
  EXPECT_LT(report["from_behind"], 0.8);
}

/// A closed body whose normals all point inwards shows its inside, about as many points as its
/// outside would.
TEST_F(SplatCommand, ABodyTurnedInsideOutIsNoted) {
  const auto shown = [&](double outwards) {
    write_ball(outwards);
    const Result result = defray(
        folder_,
        "splat ball.xyz -o o.exr --json --size 200x200 --aperture-diameter 300 --focal-length 50");
    expect_ok(result);
    return json::parse(result.out);
  };
  EXPECT_TRUE(shown(1)["notes"].empty());
  EXPECT_FALSE(shown(1)["is_inside_out"].get<bool>());
  const json turned = shown(-1);
  ASSERT_EQ(turned["notes"].size(), 1u);
  EXPECT_NE(turned["notes"][0].get<std::string>().find("normals may point inwards"),
            std::string::npos);
  EXPECT_TRUE(turned["is_inside_out"].get<bool>());
}

/// A body's back lies before the floor behind it, and that is no mistake.
TEST_F(SplatCommand, ABodyBeforeAFloorIsNotInsideOut) {
  for (const bool is_turned : {false, true}) {
    write_ball(is_turned ? -1 : 1);
    std::ofstream points(folder_ / "ball.xyz", std::ios::app);
    for (int i = 0; i < 3600; ++i) {
      points << 0.1 * (i % 60) - 3 << " -1.1 " << 0.1 * (i / 60) - 5 << " 0 1 0\n";
    }
    points.close();
    const Result result =
        defray(folder_,
               "splat ball.xyz -o o.exr --json --size 200x200 --from 0,2,4 --look-at 0,0,0 "
               "--aperture-diameter 300 --focal-length 50");
    expect_ok(result);
    EXPECT_EQ(json::parse(result.out)["is_inside_out"].get<bool>(), is_turned);
  }
}

/// Without normals, from outside it looks as with them, also from a cache; and from inside it is a
/// room.
TEST_F(SplatCommand, AClosedBodyWithoutNormalsHasAnOutside) {
  const auto shown = [&](const std::string& options) {
    const Result result = defray(folder_,
                                 "splat ball.xyz -o o.exr --json --size 100x100 --focus 2 "
                                 "--aperture-diameter 300 --focal-length 50 " +
                                     options);
    expect_ok(result);
    return json::parse(result.out);
  };
  const auto alpha = [&] { return ImageFile::read(folder_ / "o.exr").plane(0, 3); };
  const std::string outside = "--from 0,0,4 ", inside = "--from 0,0,0.1 --look-at 1,0,0 ";
  write_ball(1);
  const double behind = shown(outside)["from_behind"];
  const Plane given = alpha();
  shown(inside);
  EXPECT_LT(alpha()[50 * 100 + 50], 0.01f);
  write_ball(0);
  for (const char* cache : {"", "--cache ", "--cache "}) {
    const json report = shown(outside + cache);
    EXPECT_EQ(report["points"], 600);
    EXPECT_NEAR(report["from_behind"], behind, 0.01);
    EXPECT_LT(report["both_sides"], 0.01);
    const Plane found = alpha();
    for (std::size_t i = 0; i < given.size(); ++i) ASSERT_NEAR(found[i], given[i], 0.05) << i;
    const json room = shown(inside + cache);
    EXPECT_EQ(room["from_behind"], 0);
    EXPECT_EQ(room["both_sides"], 1);
    EXPECT_FALSE(room["is_inside_out"].get<bool>());
    EXPECT_GT(alpha()[50 * 100 + 50], 0.95f);
  }
  const auto notes = [&](const std::string& options) {
    return shown("--from 0,0,4 --look-at 0,0,0 " + options)["notes"].dump();
  };
  EXPECT_EQ(notes(""), "[]");
  // Both sides of what is before the focus count, where asked for: too much at its rims.
  shown(outside + "--two-sided");
  const Plane both = alpha();
  EXPECT_GT(std::accumulate(both.begin(), both.end(), 0.0),
            1.01 * std::accumulate(given.begin(), given.end(), 0.0));
}

TEST_F(SplatCommand, AnOpenSurfaceWithoutNormalsIsNoted) {
  std::ofstream points(folder_ / "open.xyz");
  for (int i = 0; i < 400; ++i) points << 0.1 * (i % 20) - 1 << " " << 0.1 * (i / 20) - 1 << " 0\n";
  points << "nan 0 0\n";
  points.close();
  const auto notes = [&](const std::string& options) {
    const Result result = defray(folder_,
                                 "splat open.xyz -o o.exr --json --size 100x100 --focus 2 "
                                 "--focal-length 50 --from 0,0,4 --aperture-diameter " +
                                     options);
    expect_ok(result);
    return json::parse(result.out)["notes"].dump();
  };
  const std::string open =
      "100 % of the surface has no normals and is not closed, and is seen from";
  EXPECT_NE(notes("300").find(open), std::string::npos);
  EXPECT_EQ(notes("10").find(open), std::string::npos) << "hardly blurred";
  EXPECT_NE(notes("10").find("1 of 401 points have no finite place"), std::string::npos);
}

}  // namespace
}  // namespace defray::test::splat_sides_test
