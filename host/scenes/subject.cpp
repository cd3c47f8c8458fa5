#include "scenes/subject.h"

#include <cmath>

namespace defray {

Subject make_subject(Backend& backend, Scene scene, const std::string& setting) {
  Subject s{std::move(scene), {}, {}, {}};
  s.lens = lens_of(s.scene, find_setting(s.scene, setting));
  s.pinhole = render_pinhole(s.scene);
  for (float& z : s.pinhole.depth) {
    if (z >= static_cast<float>(nothing_there)) z = HUGE_VALF;
  }
  s.coc = backend.coc(s.lens, s.scene.width, s.pinhole.depth);
  return s;
}

std::vector<Plane> render(Backend& backend, const Subject& s, const MethodSettings& settings) {
  Frame frame{s.scene.width,
              s.scene.height,
              {},
              Values<float>::view(s.pinhole.depth.data(), s.pinhole.depth.size()),
              Planes::view(s.pinhole.colour)};  // not copied: that would be timed too
  frame.coc_quanta = backend.coc(s.lens, s.scene.width, frame.depth);
  return apply_method(frame, settings, backend).colour;
}

}  // namespace defray
