// Points made ready: what is estimated, what is left out.
#include "splat/surfels/surfels.h"

#include <cmath>

#include "base/random.h"
#include "base/vec3.h"
#include "host/splat/splat_clouds.h"
#include "support.h"

namespace defray::test::surfels_test {
namespace {

const DefraySplatNode& middle(const Surfels& surfels) {
  return surfels.points[surfels.points.size() / 2];
}

TEST(Surfels, NormalsSpacingsAndAreasComeFromThePointsAround) {
  const Surfels surfels = make_surfels(slope(21));
  const DefraySplatNode& n = middle(surfels);
  const double area =
      0.01 * std::sqrt(1.25);  // 3 % more than that, so that sums are no less than 1
  EXPECT_NEAR(area_of(n), 1.03 * area, 0.02 * area);
  EXPECT_NEAR(std::abs(n.area_z) / area_of(n), 1 / std::sqrt(1.25), 1e-4);
  EXPECT_NEAR(n.area_x / n.area_z, -0.5, 1e-4);
  EXPECT_NEAR(n.variance, std::pow(0.8, 2) * area, 0.15 * area);
  EXPECT_FALSE(surfels.has_normals);
  EXPECT_EQ(middle(surfels).both_sides, 1);
  EXPECT_FALSE(surfels.has_colours);
  EXPECT_EQ(n.r, 0.5f);
  EXPECT_EQ(n.a, 1);
  EXPECT_TRUE(surfels.notes.empty());
  // At the edge no more than half as much again: there is no surface beyond to cover.
  EXPECT_LT(area_of(surfels.points[10]), 1.5 * area);
}

/// The back of something thin is not seen from before it, and covers nothing there.
TEST(Surfels, AThinThingsBackWeighsNothingInFront) {
  PointCloud sheet = slope(21);
  const std::size_t points = sheet.positions.size();
  sheet.normals.assign(points, {-0.5f, 0, 1});
  sheet.radii.assign(points, 0.1f);
  const double alone = area_of(middle(make_surfels(sheet)));
  for (std::size_t i = 0; i < points; ++i) {
    const auto& p = sheet.positions[i];
    sheet.positions.push_back({p[0], p[1], p[2] - 0.01f});
    sheet.normals.push_back({0.5f, 0, -1});
    sheet.radii.push_back(0.1f);
  }
  EXPECT_GT(area_of(make_surfels(sheet).points[points / 2]), 0.8 * alone);
}

TEST(Surfels, NormalsAreThoseOfTheShapeAtEveryScale) {
  for (const float scale : {1e-5f, 1.0f, 1e5f}) {
    PointCloud cloud = slope(9);
    for (auto& p : cloud.positions) {
      for (float& v : p) v *= scale;
    }
    const Surfels surfels = make_surfels(cloud);
    const DefraySplatNode& n = middle(surfels);
    EXPECT_NEAR(n.area_x / n.area_z, -0.5, 1e-3) << scale;
    EXPECT_NEAR(n.area_y / n.area_z, 0, 1e-3) << scale;
  }
}

TEST(Surfels, WhatIsGivenIsTaken) {
  PointCloud cloud = slope(9);
  const std::size_t count = cloud.positions.size();
  for (auto& place : cloud.positions) place[2] = 0;  // or they turn to the slope
  cloud.normals.assign(count, {0, 0, -7});
  cloud.radii.assign(count, 0.3f);
  cloud.colours.assign(count, {0.2f, 0.4f, 0.8f});
  cloud.alpha.assign(count, 0.5f);
  const Surfels surfels = make_surfels(cloud);
  const DefraySplatNode& n = middle(surfels);
  EXPECT_LT(n.area_z, 0);
  EXPECT_EQ(n.area_x, 0);
  EXPECT_FLOAT_EQ(n.variance, 0.24f * 0.24f);
  EXPECT_FLOAT_EQ(n.r, 0.1f);
  EXPECT_FLOAT_EQ(n.b, 0.4f);
  EXPECT_EQ(n.a, 0.5f);
  EXPECT_TRUE(surfels.has_normals);
  EXPECT_EQ(middle(surfels).both_sides, 0);
  EXPECT_TRUE(surfels.has_colours);
}

TEST(Surfels, NotesWhatItLeavesOutOrEstimates) {
  PointCloud cloud = slope(9);
  const std::size_t count = cloud.positions.size();
  cloud.positions[3][1] = NAN;
  cloud.positions[5][0] = INFINITY;
  cloud.normals.assign(count, {0, 0, 1});
  cloud.normals[10] = {0, 0, 0};
  cloud.normals[11] = {NAN, 0, 0};
  cloud.radii.assign(count, 0.1f);
  cloud.radii[20] = 0;
  cloud.radii[21] = -1;
  cloud.radii[22] = NAN;
  const Surfels surfels = make_surfels(cloud);
  EXPECT_EQ(surfels.points.size(), count - 2);
  ASSERT_EQ(surfels.notes.size(), 3u);
  EXPECT_EQ(surfels.notes[0], "2 of 81 points have no finite place: left out");
  EXPECT_EQ(surfels.notes[1], "3 points have no radius above 0: estimated from those around");
  EXPECT_EQ(surfels.notes[2], "2 points have no normal: estimated from those around");
  for (const DefraySplatNode& n : surfels.points) EXPECT_GT(area_of(n), 0);
}

/// Up to the largest that is allowed, areas and variances are numbers.
TEST(Surfels, PlacesUpToTheFarthestGiveNumbers) {
  PointCloud cloud = slope(9);
  for (auto& p : cloud.positions) {
    for (float& v : p) v *= 1e14f;
  }
  for (const DefraySplatNode& n : make_surfels(cloud).points) {
    EXPECT_GT(area_of(n), 0);
    EXPECT_TRUE(std::isfinite(area_of(n)) && std::isfinite(n.variance));
  }
}

TEST(Surfels, NotesNormalsThatSayNothingAndColoursOfBytes) {
  PointCloud cloud = slope(9);
  const std::size_t count = cloud.positions.size();
  cloud.normals.assign(count, {0, 0, 0});
  cloud.colours.assign(count, {0.5f, 20, 1});
  EXPECT_EQ(make_surfels(cloud).notes,
            std::vector<std::string>{"81 points have no normal: estimated from those around"});
  cloud.colours[7][1] = 255;
  const std::vector<std::string> notes = make_surfels(cloud).notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "colours go up to 255: floats are linear light, of which white is 1");
}

TEST(Surfels, EstimatedNormalsHaveTheSideOfGivenOnes) {
  for (const float side : {1.0f, -1.0f}) {
    PointCloud cloud = slope(9);
    cloud.normals.assign(cloud.positions.size(), {0, 0, side});
    for (std::size_t i = 0; i < cloud.normals.size(); i += 3) cloud.normals[i] = {0, 0, 0};
    for (const DefraySplatNode& n : make_surfels(cloud).points) EXPECT_GT(side * n.area_z, 0);
  }
}

TEST(Surfels, AnOriginIsFinite) {
  for (const double bad : {HUGE_VAL, std::nan("")}) {
    PointCloud cloud = slope(3);
    cloud.origin[1] = bad;
    expect_error(ErrorKind::input, {"the cloud's origin has"}, [&] { make_surfels(cloud); });
  }
}

TEST(Surfels, NotesFlippedNormals) {
  PointCloud cloud = slope(9);
  cloud.normals.assign(cloud.positions.size(), {0, 0, 1});
  EXPECT_TRUE(make_surfels(cloud).notes.empty());
  for (const std::size_t i : {20, 40, 60}) cloud.normals[i] = {0, 0, -2};
  EXPECT_EQ(make_surfels(cloud).notes,
            std::vector<std::string>{"3 points have normals against those around, and are seen "
                                     "from the other side alone: flipped?"});
  for (const char* model : {"plane", "figure", "crossing", "mask"}) {
    EXPECT_TRUE(make_surfels(make_point_cloud(model, 3000)).notes.empty()) << model;
  }
}

/// The bottom of what stands on something points against it, as it should, though it is coarser.
TEST(Surfels, WhatStandsOnAFloorIsNotFlipped) {
  PointCloud cloud = slope(30);
  cloud.normals.assign(cloud.positions.size(), {-0.5f, 0, 1});
  for (int i = 0; i < 15 * 15; ++i) {
    const float x = 0.05f + 0.2f * static_cast<float>(i % 15);
    cloud.positions.push_back({x, 0.05f + 0.2f * static_cast<float>(i / 15), x / 2});
    cloud.normals.push_back({0.5f, 0, -1});
  }
  EXPECT_EQ(make_surfels(cloud).notes, std::vector<std::string>{});
}

TEST(Surfels, PointsInOnePlaceHaveTheSizeOfTheOthers) {
  PointCloud cloud = slope(9);
  for (int i = 0; i < 40; ++i) cloud.positions.push_back({0.4f, 0.4f, 0.2f});
  for (const DefraySplatNode& n : make_surfels(cloud).points) {
    EXPECT_TRUE(std::isfinite(area_of(n)));
    EXPECT_GT(n.variance, 0);
  }
}

TEST(Surfels, PointsAlongALineOrAloneFaceAcrossIt) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}};
  cloud.radii = {1};
  EXPECT_FLOAT_EQ(std::abs(make_surfels(cloud).points[0].area_z),
                  area_of(make_surfels(cloud).points[0]));
  for (const std::array<float, 3> along : {std::array<float, 3>{1, 0, 0}, {0, 0, 1}, {1, 1, 1}}) {
    PointCloud line;
    for (int i = 0; i < 30; ++i) {
      line.positions.push_back({float(i) * along[0], float(i) * along[1], float(i) * along[2]});
    }
    const DefraySplatNode& n = middle(make_surfels(line));
    const double across = n.area_x * along[0] + n.area_y * along[1] + n.area_z * along[2];
    EXPECT_NEAR(across / area_of(n), 0, 1e-5);
  }
}

/// As scanners write what they have not met. Found among all others they would take minutes.
TEST(Surfels, OfPointsInOnePlaceTwentyCount) {
  PointCloud cloud = slope(21);
  const std::size_t count = cloud.positions.size();
  for (int i = 0; i < 19; ++i) cloud.positions.push_back({0, 0, 0});  // and the slope's own
  EXPECT_TRUE(make_surfels(cloud).notes.empty());
  for (int i = 0; i < 200000; ++i) cloud.positions.push_back({0, i % 2 == 0 ? 0.0f : -0.0f, 0});
  const Surfels surfels = make_surfels(cloud);
  EXPECT_EQ(surfels.points.size(), count + 19);
  ASSERT_EQ(surfels.notes.size(), 1u);
  EXPECT_EQ(surfels.notes[0], "200000 points lie where 20 others do already: left out");
  // The first are kept, with what belongs to them.
  cloud.colours.assign(cloud.positions.size(), {0.25f, 0.5f, 1});
  cloud.colours[0] = {1, 0, 0};
  cloud.colours.back() = {0, 0, 7};
  const Surfels coloured = make_surfels(cloud);
  EXPECT_EQ(coloured.points[0].r, 1);
  EXPECT_EQ(coloured.points.back().b, 1);
  PointCloud heap;
  heap.positions.assign(100, {1, 2, 3});
  try {
    make_surfels(heap);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("points (100) all lie in one place"),
              std::string::npos)
        << error.what();
  }
}

TEST(Surfels, WhatItRefuses) {
  const auto refused = [](const PointCloud& cloud, ErrorKind kind, const std::string& words) {
    try {
      make_surfels(cloud);
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused({}, ErrorKind::input, "no points");
  PointCloud nowhere = slope(1);
  nowhere.positions[0][2] = NAN;
  refused(nowhere, ErrorKind::input, "no points with a finite place");
  refused(slope(1), ErrorKind::input,
          "the cloud's points (one) all lie in one place, and say nothing of their size: give them "
          "a radius");
  PointCloud lost = slope(2);
  lost.positions[0][0] = NAN;
  lost.positions[1][1] = lost.positions[3][2] = INFINITY;
  refused(lost, ErrorKind::input,
          "the cloud's points (one; 3 without a finite place are left out) all lie in one place");
  PointCloud sized = slope(1);
  sized.radii = {1};
  EXPECT_EQ(make_surfels(sized).points.size(), 1u);
  PointCloud odd = slope(3);
  odd.normals.resize(8);
  refused(odd, ErrorKind::usage, "normals has 8 values: the cloud has 9 points");
  PointCloud coloured = slope(2);
  coloured.colours.assign(4, {0, 0, 0});
  coloured.colours[2][1] = INFINITY;
  refused(coloured, ErrorKind::input, "point 2 has the colour 0 inf 0");
  PointCloud clear = slope(2);
  clear.alpha = {1, 1, 1, 1.5f};
  refused(clear, ErrorKind::input, "point 3 has alpha 1.5");
  for (const float far : {2e15f, -3e38f}) {
    PointCloud stray = slope(3);
    stray.positions[4][1] = far;
    refused(stray, ErrorKind::input, "point 4 lies ");
    stray = slope(3);
    stray.radii.assign(9, 1);
    stray.radii[5] = std::fabs(far);
    refused(stray, ErrorKind::input, "point 5 has the radius ");
  }
}

}  // namespace
}  // namespace defray::test::surfels_test
