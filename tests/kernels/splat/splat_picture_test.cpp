// Point clouds through the lens, whole: occlusion, the mean of views, levels of detail.
#include <algorithm>
#include <cmath>

#include "measure/metrics.h"
#include "splat/splats.h"
#include "splat_support.h"

namespace defray::test::splat_picture_test {
namespace {

double mean_over(const Plane& plane, int side, int x0, int x1, int y0, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) sum += plane[size(y * side + x)];
  }
  return sum / ((x1 - x0) * (y1 - y0));
}

/// PSNR to the mean of 200 views, in dB.
double to_views(const Hierarchy& tree, const std::vector<Plane>& views, double aperture,
                SplatPsf psf) {
  SplatSettings settings;
  settings.psf = psf;
  return compare(draw(tree, view_of(256, 3.2, aperture, settings)).colour, views, 256).psnr_srgb_db;
}

TEST(SplatPicture, IsTheMeanOfViews) {
  SKIP_UNLESS_FULL();
  for (const auto& [name, aperture, gaussian_db, disc_db] : {std::tuple{"plane", 100.0, 43.0, 49.0},
                                                             {"plane", 300.0, 40.5, 49.0},
                                                             {"plane", 900.0, 30.0, 43.0},
                                                             {"figure", 300.0, 40.0, 47.0},
                                                             {"figure", 900.0, 30.0, 47.0}}) {
    const Hierarchy tree = tree_of(make_point_cloud(name, 65536));
    const std::vector<Plane> views =
        mean_of_views(device(), {&tree}, view_of(256, 3.2, aperture), 200);
    EXPECT_GT(to_views(tree, views, aperture, SplatPsf::gaussian), gaussian_db) << name << aperture;
    EXPECT_GT(to_views(tree, views, aperture, SplatPsf::disc), disc_db) << name << aperture;
    if (aperture < 900) EXPECT_NEAR(mean_over(views[3], 256, 100, 156, 100, 156), 1, 0.01);
  }
}

TEST(SplatPicture, LevelsOfDetailShowWhatPointsShow) {
  for (const std::string name : {"plane", "figure"}) {
    const Hierarchy tree = tree_of(make_point_cloud(name, 30000));
    for (const double aperture : {0.0, 200.0, 800.0}) {
      const DefraySplatParams p = view_of(128, 3.2, aperture);
      SplatReport with, without;
      const SplatPlanes a = draw_splats(device(), tree, p, true, 0, with);
      const SplatPlanes b = draw_splats(device(), tree, p, false, 0, without);
      EXPECT_LT(with.drawn, without.drawn) << name << ", " << aperture;
      EXPECT_GT(compare(a.colour, b.colour, 128).psnr_srgb_db, 38) << name << ", " << aperture;
    }
  }
}

TEST(SplatPicture, SheetsBehindEachOtherStayApart) {
  // White before black, closer than their blur is wide: no node stands for points of both.
  const Hierarchy tree = tree_of(both(wall(120, 1, 0, {1, 1, 1}), wall(120, 1, -0.05, {0, 0, 0})));
  for (const double focus : {3.5, 6.5}) {
    CameraPose pose;
    pose.from = {0, 0, 5};
    Lens lens;
    lens.aperture_diameter_mm = 1000;
    lens.focus_distance_units = focus;
    SplatSettings settings;
    settings.width = settings.height = 256;
    DefraySplatParams blurred = splat_params(pose, {}, lens, settings);
    blurred.one_sided = 1;
    SplatReport report;
    const SplatPlanes planes = draw_splats(device(), tree, blurred, true, 0, report);
    EXPECT_LT(report.drawn, 20000u);
    EXPECT_NEAR(mean_over(planes.colour[0], 256, 110, 146, 110, 146), 1, 0.01) << focus;
  }
}

TEST(SplatPicture, APointByItselfIsADiscOfItsRadius) {
  PointCloud cloud = wall(1, 0.5, 0, {1, 1, 1});
  cloud.radii = {0.05f};
  const DefraySplatParams p = view_of(128, 4, 0);
  const Plane alpha = draw(tree_of(cloud), p).colour[3];
  double sum = 0;
  for (const float value : alpha) sum += static_cast<double>(value);
  const double radius_px = 0.05 * static_cast<double>(p.focal_px) / 4;
  EXPECT_NEAR(sum / (M_PI * radius_px * radius_px), 1, 0.02);
}

TEST(SplatPicture, WhatIsOutsideIsLeftOutAndNothingElse) {
  const Hierarchy tree = tree_of(make_point_cloud("figure", 10000));
  // Near, from afar all in the picture, and with blur that brings in what lies beside it.
  for (const auto& [distance, aperture, most] :
       {std::tuple{1.2, 0.0, 0.575}, {20.0, 0.0, 1.0}, {1.2, 400.0, 0.8}}) {
    const DefraySplatParams p = view_of(64, distance, aperture);
    SplatReport report;
    const SplatPlanes cut = draw_splats(device(), tree, p, false, 0, report);
    EXPECT_LE(static_cast<double>(report.drawn), most * static_cast<double>(report.points));
    const Values<DefraySplatNode> all(tree.points);
    const SplatPlanes whole =
        device().splat_resolve(in_order(device().splat_project(all, tree.ridges, p)), p, {});
    EXPECT_EQ(cut.colour, whole.colour) << distance << ", " << aperture << " mm";
    EXPECT_EQ(cut.depth, whole.depth) << distance << ", " << aperture << " mm";
  }
}

TEST(SplatPicture, ASharpObjectBeforeABlurredOneKeepsItsEdge) {
  // A black square in focus before a white wall far behind.
  PointCloud cloud = both(wall(80, 0.4, 0, {0, 0, 0}), wall(160, 6, -6, {1, 1, 1}));
  const Hierarchy tree = tree_of(cloud);
  const int side = 128;
  const Plane red = draw(tree, view_of(side, 4, 200)).colour[0];
  const double focal = side * 50.0 / 36;
  const int edge = static_cast<int>(side / 2 + focal * 0.4 / 4);
  // The edge is as sharp as the prefilter, and nothing of the wall is on the square.
  EXPECT_LT(mean_over(red, side, edge - 8, edge - 4, 60, 68), 0.01);
  EXPECT_GT(mean_over(red, side, edge + 4, edge + 8, 60, 68), 0.97);
}

TEST(SplatPicture, ABlurredMaskBeforeASharpBodyShowsItThroughItsHole) {
  // A near black wall with a hole as wide as its blur; behind it a white wall in focus. Truth: the
  // share of the lens that the hole leaves open, from each pixel.
  PointCloud mask = wall(160, 0.6, 2, {0, 0, 0}), body = wall(120, 1.5, 0, {1, 1, 1});
  PointCloud pierced;
  const double hole = 0.15;
  for (std::size_t i = 0; i < mask.positions.size(); ++i) {
    if (std::hypot(mask.positions[i][0], mask.positions[i][1]) < hole) continue;
    pierced.positions.push_back(mask.positions[i]);
    pierced.normals.push_back(mask.normals[i]);
    pierced.colours.push_back(mask.colours[i]);
    pierced.alpha.push_back(1);
  }
  const Hierarchy tree = tree_of(both(pierced, body));
  const int side = 160;
  SplatSettings settings;
  settings.psf = SplatPsf::disc;
  const double aperture_mm = 400;
  const Plane red = draw(tree, view_of(side, 4, aperture_mm, settings)).colour[0];
  double worst = 0;
  for (int x = side / 2; x < side / 2 + 24; ++x) {
    // The ray from lens point (u, v) to the body's point X at z = 4 crosses the mask, half way, at
    // (u + X) / 2.
    const double body_x = (x + 0.5 - side / 2.0) / (side * 50.0 / 36) * 4;
    int open = 0, all = 0;
    for (int j = 0; j < 100; ++j) {
      for (int i = 0; i < 100; ++i) {
        const double u = (2 * (i + 0.5) / 100 - 1), v = (2 * (j + 0.5) / 100 - 1);
        if (u * u + v * v > 1) continue;
        const double radius = aperture_mm / 2000;
        ++all;
        open += std::hypot((radius * u + body_x) / 2, radius * v / 2) < hole;
      }
    }
    const double seen = red[size(side / 2 * side + x)];
    worst = std::max(worst, std::abs(seen - double(open) / all));
  }
  EXPECT_LT(worst, 0.06);
}

TEST(SplatPicture, TransparencyIsWhatPointsLetThrough) {
  const Hierarchy tree = tree_of(wall(80, 1, 0, {1, 1, 1}));
  const DefraySplatParams p = view_of(96, 4, 0);
  SplatReport ignored;
  const Plane alpha = draw_splats(device(), tree, p, true, 0.3, ignored).colour[3];
  EXPECT_NEAR(mean_over(alpha, 96, 40, 56, 40, 56), 0.7, 0.005);
}

TEST(SplatPicture, NearestMergesCrossingSurfacesBetterThanTheAverage) {
  SKIP_UNLESS_FULL();
  const PointCloud all = make_point_cloud("crossing", 40000);
  const auto half = [&](std::ptrdiff_t which) {  // the one surface's points come first
    const auto of = [&](const auto& values) {
      const auto begin = values.begin() + which * (std::ssize(values) / 2);
      return std::vector(begin, begin + std::ssize(values) / 2);
    };
    PointCloud cloud;
    cloud.positions = of(all.positions);
    cloud.normals = of(all.normals);
    cloud.colours = of(all.colours);
    return tree_of(cloud);
  };
  const Hierarchy tree = tree_of(all), one = half(0), other = half(1);
  for (const double aperture : {0.0, 300.0}) {
    const std::vector<Plane> apart =
        mean_of_views(device(), {&one, &other}, view_of(200, 3.6, aperture), 100);
    SplatSettings average;
    average.merge = SplatMerge::average;
    const auto psnr = [&](const SplatSettings& s) {
      return compare(draw(tree, view_of(200, 3.6, aperture, s)).colour, apart, 200).psnr_srgb_db;
    };
    EXPECT_GT(psnr({}), psnr(average)) << aperture;
  }
}

TEST(SplatPicture, SameBitsForEveryWorkGroupAndByTheTwins) {
  const Hierarchy tree = tree_of(make_point_cloud("mask", 6000));
  const DefraySplatParams p = view_of(100, 12, 300);
  SplatReport ignored;
  const auto twin = draw_splats(twins(), tree, p, true, 0, ignored);
  const auto own = draw(tree, p);
  EXPECT_EQ(hash_of(own.colour), hash_of(twin.colour));
  EXPECT_EQ(own.depth, twin.depth);
  for (const auto& [x, y] : {std::pair{1, 1}, {3, 5}, {8, 2}}) {
    session().set_work_group(size(x), size(y));
    EXPECT_EQ(hash_of(draw(tree, p).colour), hash_of(twin.colour)) << x << "x" << y;
  }
  session().set_work_group(0, 0);
}

}  // namespace
}  // namespace defray::test::splat_picture_test
