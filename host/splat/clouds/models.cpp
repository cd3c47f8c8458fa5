// Those of Krivanek & Zara 2003, or what stands in for them.
#include "splat/clouds/models.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/text.h"
#include "base/vec3.h"
#include "splat/clouds/cloud_columns.h"

namespace defray {
namespace {

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

void add(PointCloud& cloud, const Vec3& place, const Vec3& normal, const Vec3& colour,
         double alpha = 1) {
  cloud.positions.push_back(floats(place));
  cloud.normals.push_back(floats(normal));
  cloud.colours.push_back(floats(colour));
  cloud.alpha.push_back(static_cast<float>(alpha));
}

/// Tiles with a pattern in each, finer from left to right.
Vec3 tiles(double u, double v) {
  const auto tile = [](double t) { return static_cast<int>(std::floor(t * 4)); };
  const bool is_light = (tile(u) + tile(v)) % 2 == 0;
  const double lines = std::sin((8 + 40 * u) * v * 2 * M_PI) > 0 ? 1 : 0.4;
  return is_light ? Vec3{0.8, 0.75, 0.6} * lines : Vec3{0.1 + 0.5 * u, 0.15, 0.6 - 0.5 * u};
}

int side_of(std::size_t points) {
  return std::max(2, static_cast<int>(std::lround(std::sqrt(static_cast<double>(points)))));
}

/// A square grid: the middle, and what half its sides are.
void add_square(PointCloud& cloud, int side, const Vec3& middle, const Vec3& across, const Vec3& up,
                const std::function<Vec3(double, double)>& colour) {
  const Vec3 normal = normalized(cross(across, up));
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double u = (i + 0.5) / side, v = (j + 0.5) / side;
      add(cloud, middle + across * (2 * u - 1) + up * (2 * v - 1), normal, colour(u, v));
    }
  }
}

/// Leans back by 50 degrees.
PointCloud plane(std::size_t points) {
  PointCloud cloud;
  const double lean = 50 * M_PI / 180;
  add_square(cloud, side_of(points), {}, {1, 0, 0}, {0, std::cos(lean), -std::sin(lean)}, tiles);
  return cloud;
}

/// Two squares that cut each other along a line.
PointCloud crossing(std::size_t points) {
  PointCloud cloud;
  const int side = side_of(points / 2);
  add_square(cloud, side, {}, {0.8, 0, -0.6}, {0, 1, 0},
             [](double u, double v) { return tiles(u, v); });
  add_square(cloud, side, {}, {0.8, 0, 0.6}, {0, 1, 0}, [](double u, double v) {
    return Vec3{0.7, 0.2, 0.1} * (0.5 + 0.5 * (std::sin(30 * u) * std::sin(30 * v) > 0));
  });
  return cloud;
}

/// A rounded body with a head, ears, legs and a tail: a radius for each direction.
double figure_radius(const Vec3& d) {
  struct Lobe {
    Vec3 towards;
    double height, sharpness;
  };
  static const Lobe lobes[] = {{{0, 0.62, 0.78}, 0.55, 9},     {{0.33, 0.83, 0.45}, 0.3, 60},
                               {{-0.33, 0.83, 0.45}, 0.3, 60}, {{0, 0.45, 0.89}, 0.12, 120},
                               {{0.5, -0.75, 0.45}, 0.5, 25},  {{-0.5, -0.75, 0.45}, 0.5, 25},
                               {{0.5, -0.75, -0.45}, 0.5, 25}, {{-0.5, -0.75, -0.45}, 0.5, 25},
                               {{0, 0.35, -0.94}, 0.6, 70}};
  double radius = 0.6;
  for (const Lobe& lobe : lobes) {
    radius += lobe.height * std::exp(lobe.sharpness * (dot(d, normalized(lobe.towards)) - 1));
  }
  return radius;
}

Vec3 figure_colour(const Vec3& d) {
  const double stripes =
      std::sin(22 * d.x + 6 * std::sin(7 * d.y)) + 0.6 * std::sin(31 * d.y + 9 * d.z);
  return mix({0.75, 0.45, 0.12}, {0.2, 0.09, 0.03}, std::clamp(0.5 + stripes, 0.0, 1.0));
}

/// A surface around a middle, points as dense in all directions (a spiral).
void add_figure(PointCloud& cloud, std::size_t points, const Vec3& middle, double scale) {
  const double golden = M_PI * (3 - std::sqrt(5.0));
  const auto at = [](const Vec3& d) {
    const Vec3 unit = normalized(d);
    return unit * figure_radius(unit);
  };
  for (std::size_t i = 0; i < points; ++i) {
    const double y = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(points);
    const double turn = golden * static_cast<double>(i), ring = std::sqrt(1 - y * y);
    const Vec3 d{ring * std::cos(turn), y, ring * std::sin(turn)};
    const Vec3 beside = normalized(cross(d, std::abs(d.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
    const Vec3 over = cross(d, beside);
    constexpr double step = 1e-4;
    const Vec3 along = at(d + beside * step) - at(d - beside * step);
    const Vec3 across = at(d + over * step) - at(d - over * step);
    const Vec3 normal = normalized(cross(along, across));
    // Lit from above on the left, as scans are that have their light in their colours.
    const double light = 0.35 + 0.65 * std::max(0.0, dot(normal, normalized({-0.5, 0.8, 0.6})));
    add(cloud, middle + at(d) * scale, dot(normal, d) > 0 ? normal : -normal,
        figure_colour(d) * light);
  }
}

PointCloud figure(std::size_t points) {
  PointCloud cloud;
  add_figure(cloud, points, {}, 1);
  return cloud;
}

/// A half-transparent mask with eyes before a body (figure 1 of the paper).
PointCloud mask(std::size_t points) {
  PointCloud cloud;
  add_figure(cloud, points / 2, {0, 0, -1.2}, 1);
  const int side = side_of(points / 2);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = 2 * (i + 0.5) / side - 1, y = 2 * (j + 0.5) / side - 1;
      const double eye = std::hypot((std::abs(x) - 0.4) / 0.2, (y - 0.25) / 0.12);
      if (x * x + y * y > 1 || eye < 1) continue;
      const double bend = std::sqrt(1.5 - x * x - 0.5 * y * y);
      const Vec3 normal = normalized({0.5 * x / bend, 0.25 * y / bend, 1});
      const double line = std::fmod(10 * std::hypot(x, y), 1.0) < 0.3 ? 0.5 : 1;
      add(cloud, {0.8 * x, 0.8 * y, 0.4 * bend}, normal, Vec3{0.3, 0.6, 0.7} * line, 0.5);
    }
  }
  return cloud;
}

struct Model {
  const char* name;
  std::size_t points;
  PointCloud (*make)(std::size_t points);
};

constexpr Model models[] = {{"plane", 262144, plane},
                            {"figure", 81458, figure},
                            {"crossing", 131072, crossing},
                            {"mask", 120000, mask}};

}  // namespace

PointCloud model_cloud(const std::string& name, std::size_t points) {
  std::vector<std::string> names;
  for (const Model& model : models) {
    if (name == model.name) {
      if (points > 0) check_memory_for(points, "model " + name);
      return model.make(points > 0 ? points : model.points);
    }
    names.emplace_back(model.name);
  }
  fail(ErrorKind::usage, "{}", not_known("model", name, names));
}

}  // namespace defray
