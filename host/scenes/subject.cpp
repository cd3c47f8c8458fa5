#include "scenes/subject.h"

#include <cmath>

namespace defray {

Subject make_subject(Session& session, Scene scene, const std::string& setting) {
  Subject s{std::move(scene), {}, {}, {}};
  s.lens = lens_of(s.scene, find_setting(s.scene, setting));
  s.pinhole = render_pinhole(s.scene);
  for (float& z : s.pinhole.depth) {
    if (z >= static_cast<float>(nothing_there)) z = HUGE_VALF;
  }
  s.coc = coc_on_device(session, s.lens, s.scene.width, s.pinhole.depth);
  return s;
}

std::vector<Plane> render(Session& session, const Subject& s, const MethodSettings& settings) {
  const auto coc = coc_on_device(session, s.lens, s.scene.width, s.pinhole.depth);
  return apply_method({s.scene.width, s.scene.height, coc, s.pinhole.depth, s.pinhole.colour},
                      settings, &session);
}

}  // namespace defray
