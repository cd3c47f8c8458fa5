// Noise in a cloud's places and normals.
#include "splat/surfels/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace defray::test::smoothing_test {
namespace {

/// Points whose normals are known, 1 apart.
CloudPoints known(const std::vector<Vec3>& places, const std::vector<Vec3>& normals) {
  std::vector<std::array<float, 3>> at;
  std::vector<CloudPoint> points;
  for (std::size_t i = 0; i < places.size(); ++i) {
    at.push_back({float(places[i].x), float(places[i].y), float(places[i].z)});
    points.push_back({.normal = normals[i], .spacing = 1});
  }
  Neighbours around(at, neighbour_count);
  return {at, points, around};
}

/// Of a square's points those with all others around them.
constexpr int side = 40;
bool is_inside(std::size_t i) {
  const auto column = static_cast<int>(i) % side, row = static_cast<int>(i) / side;
  return std::min({column, row, side - 1 - column, side - 1 - row}) > 2;
}

/// A grid, or what `bend` makes of it, off by so much of a spacing and so many radians.
template <typename Bend>
CloudPoints sheet(double height_noise, double normal_noise, const Bend& bend) {
  std::vector<Vec3> places, normals;
  for (int i = 0; i < side * side; ++i) {
    Random random(i, 0, 2);
    const auto off = [&](double most) { return most * (2 * random.next() - 1); };
    const auto [place, normal] = bend(i % side - side / 2 + off(0.1), i / side - side / 2);
    places.push_back(place + normal * off(height_noise));
    normals.push_back(
        normalized(normal + Vec3{off(normal_noise), off(normal_noise), off(normal_noise)}));
  }
  return known(places, normals);
}

std::pair<Vec3, Vec3> flat(double x, double y) { return {{x, y, 0}, {0, 0, 1}}; }
std::pair<Vec3, Vec3> tube(double x, double y) {
  constexpr double radius = 8;
  const Vec3 out{std::sin(x / radius), 0, std::cos(x / radius)};
  return {out * radius + Vec3{0, y, 0}, out};
}

struct Change {
  double moved = 0, turned = 0;  ///< The largest.
};
Change change_by_smoothing(CloudPoints cloud) {
  const CloudPoints before = cloud;
  smooth(cloud);
  Change most;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!is_inside(i)) continue;
    most.moved = std::max(most.moved, length(cloud.place(i) - before.place(i)));
    most.turned = std::max(most.turned, length(cloud.points[i].normal - before.points[i].normal));
  }
  return most;
}

TEST(Smoothing, WhatCurvesEvenlyStaysAsItIs) {
  EXPECT_LT(change_by_smoothing(sheet(0, 0, flat)).moved, 1e-6);
  EXPECT_LT(change_by_smoothing(sheet(0, 0, flat)).turned, 1e-6);
  EXPECT_LT(change_by_smoothing(sheet(0, 0, tube)).moved, 0.01);
  EXPECT_LT(change_by_smoothing(sheet(0, 0, tube)).turned, 0.01);  // of 0.125 from each to the next
  const Change ball = change_by_smoothing(sheet(0, 0, [](double x, double y) {
    const Vec3 out = normalized({x, y, 12});
    return std::pair{out * 12.0, out};
  }));
  EXPECT_LT(ball.moved, 1e-5);
  EXPECT_LT(ball.turned, 1e-5);
}

TEST(Smoothing, TakesAwayNoise) {
  for (const bool is_bent : {false, true}) {
    const double height_noise = 0.1, normal_noise = 0.1;
    CloudPoints cloud =
        is_bent ? sheet(height_noise, normal_noise, tube) : sheet(height_noise, normal_noise, flat);
    const CloudPoints clean = is_bent ? sheet(0, 0, tube) : sheet(0, 0, flat);
    double height = 0, turned = 0, height_before = 0, turned_before = 0;
    const auto add = [&](const CloudPoints& of, double& heights, double& turns) {
      for (std::size_t i = 0; i < of.points.size(); ++i) {
        if (!is_inside(i)) continue;
        const Vec3& normal = clean.points[i].normal;
        heights += std::pow(dot(of.place(i) - clean.place(i), normal), 2);
        turns += 1 - std::pow(dot(of.points[i].normal, normal), 2);
      }
    };
    add(cloud, height_before, turned_before);
    smooth(cloud);
    add(cloud, height, turned);
    EXPECT_LT(height, 0.1 * height_before) << is_bent;
    EXPECT_LT(turned, 0.1 * turned_before) << is_bent;
  }
}

/// What lies beyond a ridge, or is another sheet's, says nothing.
TEST(Smoothing, FacesAndSheetsKeepTheirPlaces) {
  const auto roof = [](double x, double y) {  // with points on its ridge
    const double sign = x < 0 ? -1 : 1;
    return std::pair{Vec3{0.8 * x, y, -0.6 * std::abs(x)}, Vec3{0.6 * sign, 0, 0.8}};
  };
  EXPECT_LT(change_by_smoothing(sheet(0, 0, roof)).moved, 1e-6);
  EXPECT_LT(change_by_smoothing(sheet(0, 0, roof)).turned, 1e-6);
  // Two sides of a thin body, and steps as high as points are apart.
  const auto sides = [](double x, double y) {
    const double sign = std::lround(y) % 2 == 0 ? -1 : 1;
    return std::pair{Vec3{x, y, 0.5 * sign}, Vec3{0, 0, sign}};
  };
  EXPECT_LT(change_by_smoothing(sheet(0, 0, sides)).moved, 1e-6);
  const auto steps = [](double x, double y) {
    return std::pair{Vec3{x, y, y < 0 ? 0.0 : 1.5}, Vec3{0, 0, 1}};
  };
  EXPECT_LT(change_by_smoothing(sheet(0, 0, steps)).moved, 0.15);
}

/// What lies above a surface keeps its normal: reflected by what is below it would turn over.
TEST(Smoothing, StraysStayWhatTheyAre) {
  for (const double height : {0.5, 2.0}) {
    std::vector<Vec3> places{{0.3, 0.4, height}}, normals(101, {0, 0, 1});
    normals[0] = normalized({0.2, 0, 1});
    for (int i = 0; i < 100; ++i) places.push_back({i % 10 - 4.5, i / 10 - 4.5, 0});
    CloudPoints cloud = known(places, normals);
    cloud.points[0].spacing = 2;
    smooth(cloud);
    EXPECT_NEAR(cloud.places[0][2], height, 1e-6);
    EXPECT_NEAR(dot(cloud.points[0].normal, normals[0]), 1, 1e-6) << height;
  }
}

}  // namespace
}  // namespace defray::test::smoothing_test
