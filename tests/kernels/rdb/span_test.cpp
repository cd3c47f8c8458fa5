// Fragments as pieces of a surface: kernels/rdb/span.clh.
#include <algorithm>
#include <bit>

#include "lens/lens_points.h"
#include "rdb/rdb.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::span_test {
namespace {

RayPlan plan_of(RaysBy by, bool has_spans = true) {
  RayPlan plan;
  plan.lens = make_lens_points(Aperture{}, is_slow_device() ? 7 : 61);
  plan.by = by;
  plan.has_spans = has_spans;
  return plan;
}

/// The span of the middle one of a row of radii.
reference::Span in_row(const std::vector<std::int32_t>& coc, const Plane& depth = Plane(5, 1.0f)) {
  const Frame row{5, 1, coc, depth, {Plane(5)}};
  const Frame column{1, 5, coc, depth, {Plane(5)}};
  const reference::Span span = reference::span_of(row, plan_of(RaysBy::gather), 2);
  const reference::Span upright = reference::span_of(column, plan_of(RaysBy::gather), 2);
  EXPECT_EQ(span.least, upright.least);
  EXPECT_EQ(span.largest, upright.largest);
  return span;
}

void expect_span(const reference::Span& span, std::int32_t least, std::int32_t largest) {
  EXPECT_EQ(span.least, least);
  EXPECT_EQ(span.largest, largest);
}

TEST(Span, GoesHalfWayToPixelsOfTheSameSurface) {
  expect_span(in_row({7, 7, 7, 7, 7}), 7, 7);
  expect_span(in_row({0, 100, 200, 300, 400}), 150, 250);
  expect_span(in_row({0, -51, -100, -151, -200}), -126, -76);
  expect_span(in_row({0, 0, 0, 16, 16}), 0, 8);
  expect_span(in_row({0, 0, 0, 17, 17}), 0, 0);  // another surface
  expect_span(in_row({0, 0, 60, 160, 160}), 30, 110);
  expect_span(in_row({9, 9, 29, 150, 150}), 29, 29);
  expect_span(in_row({-600, -300, 0, 400, 1200}), -150, 0);    // steep on one side, no plane
  expect_span(in_row({-700, -350, 0, 440, 1200}), -175, 220);  // two slopes that are much alike
  expect_span(in_row({0, 0, 0, 600, 1200}), 0, 0);             // no ramp is so steep
  constexpr std::int32_t limit = DEFRAY_COC_LIMIT_QUANTA;
  expect_span(in_row({-limit, -limit, limit, -limit, limit}), limit, limit);
}

TEST(Span, EndsWhereNothingIs) {
  const float none = std::bit_cast<float>(DEFRAY_EMPTY);
  expect_span(in_row({0, 100, 200, 300, 400}, {1, none, 1, 1, 1}), 200, 250);
  expect_span(in_row({0, 100, 200, 300, 400}, {1, 1, 1, none, 1}), 150, 200);
}

TEST(Span, OneSurfaceMeetsItselfInOneRadius) {
  const RayPlan plan = plan_of(RaysBy::gather);
  for (int step = -DEFRAY_JUMP_QUANTA; step <= DEFRAY_JUMP_QUANTA; ++step) {
    const Frame f{4,
                  1,
                  std::vector<std::int32_t>{10, 10 + step, 10 + 2 * step, 10 + 3 * step},
                  Plane(4, 1.0f),
                  {Plane(4)}};
    const reference::Span a = reference::span_of(f, plan, 1), b = reference::span_of(f, plan, 2);
    EXPECT_EQ(step > 0 ? a.largest : a.least, step > 0 ? b.least : b.largest) << step;
  }
}

/// A surface whose CoC grows by `slope` quanta a column and half as much a row, before a bright far
/// one at its left and right.
Frame slanted(int slope) {
  const Size size{120, 80};
  std::vector<std::int32_t> coc;
  Plane depth, colour;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool is_surface = x >= 30 && x < 90;
      coc.push_back(is_surface ? slope * (x - 60) + slope / 2 * (y - 40) : 40 * 256);
      depth.push_back(is_surface ? 2.0f : 9.0f);
      colour.push_back(is_surface ? 0.25f : 50.0f);
    }
  }
  return {size.width, size.height, std::move(coc), std::move(depth), {std::move(colour)}};
}

/// Pixels well inside the surface that anything shines through.
int leaks(Backend& backend, const Frame& f, const RayPlan& plan) {
  const RayResult result = backend.rays(f, plan);
  int count = 0;
  for (int y = 30; y < 50; ++y) {
    for (int x = 52; x < 68; ++x) count += result.means[0][f.index(x, y)] != 0.25f;
  }
  return count;
}

TEST(Span, NothingShinesThroughASurfaceWhereItsCocGrows) {
  for (const int slope : {1, 20, 51, 100, 150}) {
    const Frame f = slanted(slope);
    for (const RaysBy by : {RaysBy::gather, RaysBy::scatter}) {
      for (Backend* backend : device_and_twins()) {
        if (backend != &device() && slope != 51) continue;
        EXPECT_EQ(leaks(*backend, f, plan_of(by)), 0) << slope;
      }
      if (slope >= 20) EXPECT_GT(leaks(device(), f, plan_of(by, false)), 0) << slope;
    }
  }
}

/// Two slanted layers, the second a hair nearer: where both span the radius at which rays begin to
/// end somewhere, they are as near there, and the first counts.
TEST(Span, OfLayersThatSpanOneRadiusTheFirstCounts) {
  const int width = 80, height = 24;
  std::vector<std::int32_t> coc;
  Plane colour;
  for (int row = 0; row < 2 * height; ++row) {
    for (int x = 0; x < width; ++x) {
      coc.push_back(60 * x - 5 * (row % 2) + 30 * (row / 2));
      colour.push_back(static_cast<float>(row % 2));
    }
  }
  Frame f{width, height, std::move(coc), Plane(size(width * height * 2), 1.0f), {colour}};
  f.layers = 2;
  const RayResult gathered = device().rays(f, plan_of(RaysBy::gather));
  const RayResult scattered = device().rays(f, plan_of(RaysBy::scatter));
  EXPECT_EQ(gathered.means, scattered.means);
  EXPECT_LT(*std::ranges::min_element(gathered.means[0]), 0.9f);
  EXPECT_EQ(gathered.means, twins().rays(f, plan_of(RaysBy::gather)).means);
}

TEST(Span, TheLiteralBufferHasPoints) { EXPECT_FALSE(plan_rays(RdbSettings()).has_spans); }

}  // namespace
}  // namespace defray::test::span_test
