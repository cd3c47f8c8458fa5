#include "properties.h"

#include <rapidcheck.h>

#include <cmath>

namespace defray::test {

Size any_size() { return {*rc::gen::inRange(1, 41), *rc::gen::inRange(1, 31)}; }

RandomFrame any_frame() { return any_frame(any_size()); }

RandomFrame any_frame(Size size) {
  const auto seed = *rc::gen::inRange<std::uint32_t>(0, 1u << 16);
  return {size,
          random_coc(size, reach_px, seed),
          random_depth(size, seed + 1),
          {random_plane(size, seed + 2)}};
}

MethodSettings any_method() {
  MethodSettings s;
  s.method = *rc::gen::element(Method::rdb, Method::linear, Method::gather);
  s.rdb.cells_per_side = *rc::gen::element(1, 3, 5);
  s.gather.kind = *rc::gen::element(GatherKind::literal, GatherKind::aware);
  s.gather.samples = *rc::gen::inRange(1, 17);
  s.gather.passes = *rc::gen::inRange(1, 3);
  return s;
}

std::string name_of(const MethodSettings& s) {
  if (s.method != Method::gather) return to_string(s.method);
  return s.gather.kind == GatherKind::literal ? "gather literal" : "gather aware";
}

Plane render(const RandomFrame& frame, const MethodSettings& settings) {
  return apply_method({frame.size.width, frame.size.height, frame.coc, frame.depth, frame.channels},
                      settings, device())
      .colour[0];
}

double rounding_of(const MethodSettings& s, double linear_weight) {
  constexpr double u = 0x1p-24;
  constexpr double terms = (2 * reach_px + 3) * (2 * reach_px + 3);
  const double cells = s.rdb.cells_per_side * s.rdb.cells_per_side;
  if (s.method == Method::rdb) return (2 * cells + 5) * u;
  if (s.method == Method::linear) return (terms + 2) * linear_weight * u;
  if (s.gather.kind == GatherKind::literal)
    return s.gather.passes * (2 * s.gather.samples + 25) * u;
  return s.gather.passes * (4 * s.gather.samples + 19) * u;
}

double largest_weight(const RandomFrame& frame, const MethodSettings& settings) {
  if (settings.method != Method::linear) return 1;
  RandomFrame ones = frame;
  ones.channels = {Plane(frame.coc.size(), 1.0f)};
  // Its own rounding: terms + 2 of u = 2^-24, terms < 2^8.
  return largest(render(ones, settings)) * (1 + 0x1p-15);
}

double largest(const Plane& plane) {
  double most = 0;
  for (const float value : plane) most = std::fmax(most, std::fabs(value));
  return most;
}

double difference(const Plane& a, const Plane& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double apart = std::fabs(static_cast<double>(a[i]) - b[i]);
    most = apart <= most ? most : apart;  // NaN wins, and stays
  }
  return most;
}

std::uint64_t bits(const Plane& plane) { return hash_of({plane}); }

}  // namespace defray::test
