// Colour is light: it adds up, and scales.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "properties.h"

namespace defray::test::property_colour_test {
namespace {

RandomFrame with_colour(RandomFrame frame, Plane colour) {
  frame.channels = {std::move(colour)};
  return frame;
}

/// Reads better in a counterexample than a bare false, and says how near it was.
void assert_within(double apart, double bound, const MethodSettings& settings) {
  RC_LOG() << name_of(settings) << ": " << apart << " apart, allowed " << bound << std::endl;
  RC_ASSERT(apart <= bound);
}

// Weights are the same in all three pictures, so their errors do not count.
RC_GTEST_PROP(ColourProperty, PicturesOfTwoLightsAddUp, ()) {
  const RandomFrame a = any_frame();
  const MethodSettings settings = any_method();
  const Plane b = random_plane(a.size, *rc::gen::inRange<std::uint32_t>(0, 1u << 16));
  Plane both = b;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] += a.channels[0][i];
  Plane sum = render(a, settings);
  const Plane of_b = render(with_colour(a, b), settings);
  const Plane of_both = render(with_colour(a, both), settings);
  double apart = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    apart = std::fmax(apart, std::fabs(static_cast<double>(sum[i]) + of_b[i] - of_both[i]));
  }
  const double weight = largest_weight(a, settings);
  const double levels = largest(a.channels[0]) + largest(b) + largest(both);
  const double input = weight * largest(both) * 0x1p-24;  // both[i] is rounded
  assert_within(apart, rounding_of(settings, weight) * levels + input, settings);
}

// Not `linear`: where the radius changes its pixels get more or less than all of a constant.
RC_GTEST_PROP(ColourProperty, AConstantIsAdded, ()) {
  const RandomFrame frame = any_frame();
  const MethodSettings settings = any_method();
  RC_PRE(settings.method != Method::linear);
  const float constant = *rc::gen::inRange(-800, 800) / 8.0f;
  Plane raised = frame.channels[0], expected = render(frame, settings);
  for (float& value : raised) value += constant;
  const Plane result = render(with_colour(frame, raised), settings);
  double apart = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    apart = std::fmax(apart, std::fabs(static_cast<double>(expected[i]) + constant - result[i]));
  }
  const double levels = largest(frame.channels[0]) + largest(raised);
  const double input = largest(raised) * 0x1p-24;
  assert_within(apart, rounding_of(settings) * levels + input, settings);
}

// Every rounding scales with it; the exponents stay far from float's ends.
RC_GTEST_PROP(ColourProperty, APowerOfTwoScalesExactly, ()) {
  const RandomFrame frame = any_frame();
  const MethodSettings settings = any_method();
  const int exponent = *rc::gen::inRange(-20, 21);
  Plane scaled = frame.channels[0], expected = render(frame, settings);
  for (float& value : scaled) value = std::ldexp(value, exponent);
  for (float& value : expected) value = std::ldexp(value, exponent);
  RC_LOG() << name_of(settings) << std::endl;
  RC_ASSERT(bits(render(with_colour(frame, scaled), settings)) == bits(expected));
}

RC_GTEST_PROP(ColourProperty, AnyFactorScales, ()) {
  const RandomFrame frame = any_frame();
  const MethodSettings settings = any_method();
  const float factor = *rc::gen::inRange(-3000, 3000) / 1000.0f;
  Plane scaled = frame.channels[0];
  for (float& value : scaled) value *= factor;
  const Plane plain = render(frame, settings);
  const Plane result = render(with_colour(frame, scaled), settings);
  double apart = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    apart = std::fmax(apart, std::fabs(static_cast<double>(plain[i]) * factor - result[i]));
  }
  const double weight = largest_weight(frame, settings);
  const double levels = largest(frame.channels[0]) * std::fabs(factor) + largest(scaled);
  const double input = weight * largest(scaled) * 0x1p-24;
  assert_within(apart, rounding_of(settings, weight) * levels + input, settings);
}

}  // namespace
}  // namespace defray::test::property_colour_test
