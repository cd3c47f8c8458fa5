#pragma once
// Pictures whose error is expected, or wanted.
#include "prediction/with_error.h"
#include "scenes/subject.h"
#include "support.h"

namespace defray::test::expected_error_test {

/// Colour anti-aliased.
inline Subject subject_of(const std::string& scene, const std::string& setting, int width,
                          int height) {
  Subject s = make_subject(device(), make_scene(scene, width, height), setting);
  s.pinhole.colour = render_pinhole(s.scene, {64}).colour;
  return s;
}

inline MethodSettings chain_of(Quality quality) {
  MethodSettings settings;
  settings.chain = settings_for(quality);
  return settings;
}

inline ResultWithError made(const Subject& s, const MethodSettings& settings,
                            const ErrorSettings& error, Backend& backend = device()) {
  return apply_with_error(s.frame(), settings, error, backend, false, {});
}

inline const ErrorSettings expects{true, true, {}};

inline ErrorSettings target(double db) { return {false, false, db}; }

}  // namespace defray::test::expected_error_test
