// How close the RDB with its stages comes to the truth, what each stage costs and gains, and what
// is left.
#include "truth/truth.h"

#include <cmath>

#include "experiments.h"
#include "measure/metrics.h"

namespace defray::perf {

double Setup::psnr_db(const std::vector<Plane>& picture) const {
  return compare(picture, truth.colour, subject.scene.width).psnr_srgb_db;
}

Subject make_antialiased(Backend& backend, Scene scene, const std::string& setting,
                         bool averages_depth) {
  Subject s = make_subject(backend, std::move(scene), setting);
  s.pinhole.colour = render_pinhole(s.scene, {pinhole_samples}).colour;
  if (!averages_depth) return s;
  s.pinhole.depth = render_pinhole(s.scene, {pinhole_samples, true}).depth;
  for (float& z : s.pinhole.depth) {
    if (z >= static_cast<float>(nothing_there)) z = HUGE_VALF;
  }
  s.coc = backend.coc(s.lens, s.scene.width, s.pinhole.depth);
  return s;
}

Setup make_setup(const Bench& bench, const std::string& scene, const std::string& setting,
                 int width, int height) {
  bench.step(fmt::format("{} {}: truth", scene, setting));
  Subject s = make_antialiased(bench.backend,
                               make_scene(scene, bench.size(width), bench.size(height)), setting);
  Truth truth = render_truth(s.scene, s.lens, bench.is_quick ? 16 : 144, 1);
  return {scene, setting, std::move(s), std::move(truth)};
}

std::vector<Setup> make_setups(const Bench& bench) {
  struct Place {
    std::string scene, setting;
  };
  std::vector<Place> places{{"fence", "bg"},
                            {"fence", "fence"},
                            {"spheres", "f2"},
                            {"spheres", "f5"},
                            {"plate1", "default"},
                            {"blocks-lake", "miniature"},
                            {"blocks-forest", "miniature"},
                            {"highlights", "default"}};
  if (bench.is_quick) places.resize(5);
  std::vector<Setup> setups;
  for (const Place& place : places) {
    setups.push_back(make_setup(bench, place.scene, place.setting, 320, 208));
  }
  return setups;
}

MethodSettings default_chain(Quality quality) {
  MethodSettings s;
  s.chain = settings_for(quality);
  return s;
}

void add_pictures(const Bench& bench, const std::vector<Setup>& setups, Section& section) {
  for (const Setup& setup : setups) {
    bench.step(setup.name() + ": pictures");
    const auto literal = render(bench.backend, setup.subject, rdb_of(9));
    const auto whole = render(bench.backend, setup.subject, default_chain());
    const auto difference = difference_picture(whole, setup.truth.colour, 4);
    section.figures.push_back(
        sheet(bench, "truth-" + setup.scene + "-" + setup.setting,
              setup.name() + "; last: 4 times the difference of sRGB values, white is equal",
              {{"pinhole", &setup.subject.pinhole.colour},
               {"literal RDB 9x9", &literal},
               {"default", &whole},
               {"truth", &setup.truth.colour},
               {"default against truth", &difference}},
              setup.subject.scene.width, setup.subject.scene.height));
  }
}

Section truth(const Bench& bench) {
  Section section{"Closer to truth",
                  "One pinhole picture does not show what lies behind near things, mixes surfaces "
                  "in edge pixels, and small highlights fall between the rays. What do the stages "
                  "around the RDB gain, what do they cost, and what is left?",
                  {},
                  {},
                  {}};
  const std::vector<Setup> setups = make_setups(bench);
  add_mechanisms(bench, setups, section);
  add_split(bench, setups, section);
  add_motion(bench, section);
  add_pictures(bench, setups, section);
  return section;
}

}  // namespace defray::perf
