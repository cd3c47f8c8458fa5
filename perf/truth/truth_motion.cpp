// Scenes that move: what changes from frame to frame beside what should.
#include "measure/false_edges.h"
#include "measure/flicker.h"
#include "measure/plot.h"
#include "truth/truth.h"

namespace defray::perf {
namespace {

/// Pictures of one frame.
struct Moment {
  std::vector<Plane> pinhole, truth, literal, whole;
};

struct Film {
  const Bench& bench;
  std::string scene, setting;
  int width, height, samples;

  std::string name() const { return scene + " " + setting; }
  Subject subject(int frame) const {
    return make_antialiased(
        bench.backend, make_scene(scene, bench.size(width), bench.size(height), frame), setting);
  }
  /// `seed`: another one gives other noise.
  std::vector<Plane> truth(const Subject& s, int seed) const {
    return render_truth(s.scene, s.lens, samples, static_cast<std::uint32_t>(seed)).colour;
  }
  Moment moment(int frame) const {
    bench.step(fmt::format("{}: frame {}", name(), frame));
    const Subject s = subject(frame);
    return {s.pinhole.colour, truth(s, frame), render(bench.backend, s, rdb_of(9)),
            render(bench.backend, s, default_chain())};
  }
};

struct Mean {
  double sum = 0;
  int count = 0;
  void add(double value) { sum += value, ++count; }
  double value() const { return sum / count; }
};

/// Of changes from frame to frame, in 255ths.
struct Changes {
  Mean truth, pinhole, literal, whole,
      noise;                      ///< RMS: the truth's own, and how far others are off.
  Mean whole_false, noise_false;  ///< RMS of those that the truth has not.
  Series literal_line, whole_line;

  std::vector<std::string> row(const std::string& name) const {
    std::vector<std::string> cells{name};
    for (const Mean& mean : {truth, pinhole, literal, whole, noise, whole_false, noise_false}) {
      cells.push_back(fixed(mean.value()));
    }
    return cells;
  }
};

Changes changes_of(const Film& film, int frames) {
  Changes all;
  all.literal_line.name = film.name() + ": literal";
  all.whole_line.name = film.name() + ": default";
  const int width = film.bench.size(film.width);
  Moment before = film.moment(1);
  for (int frame = 2; frame <= frames; ++frame) {
    Moment now = film.moment(frame);
    const auto error = [&](const std::vector<Plane>& a, const std::vector<Plane>& b) {
      return 255 * flicker(a, b, before.truth, now.truth).error_rms;
    };
    const double literal = error(before.literal, now.literal);
    const double whole = error(before.whole, now.whole);
    all.truth.add(255 * flicker(now.truth, now.truth, before.truth, now.truth).truth_rms);
    all.pinhole.add(error(before.pinhole, now.pinhole));
    all.literal.add(literal);
    all.whole.add(whole);
    all.whole_false.add(false_changes(before.whole, now.whole, before.truth, now.truth, width).rms);
    all.literal_line.points.push_back({double(frame), literal});
    all.whole_line.points.push_back({double(frame), whole});
    if (frame == 2) {  // noise is alike in all
      const std::vector<Plane> first = film.truth(film.subject(1), 101);
      const std::vector<Plane> second = film.truth(film.subject(2), 102);
      all.noise.add(error(first, second));
      all.noise_false.add(false_changes(first, second, before.truth, now.truth, width).rms);
    }
    before = std::move(now);
  }
  return all;
}

}  // namespace

void add_motion(const Bench& bench, Section& section) {
  const int frames = bench.is_quick ? 3 : 24, samples = bench.is_quick ? 9 : 100;
  Table table{"truth-motion",
              fmt::format("{} frames: RMS change from frame to frame, sRGB, in 255ths: the truth's "
                          "own, by how much the methods' change is another, and what of it the "
                          "truth has not within 2 px (false)",
                          frames),
              {"focus", "truth's change", "pinhole", "literal RDB 9x9", "default",
               "truth with other noise", "default, false", "other noise, false"},
              {}};
  Plot plot{"Change from frame to frame beside the truth's", "frame", "RMS, sRGB, 255ths"};
  // The garden's blades are a pixel wide or more from this size on.
  for (const Film& film : {Film{bench, "drift", "face", 160, 120, samples},
                           {bench, "drift", "fence", 160, 120, samples},
                           {bench, "garden", "grass", 320, 200, samples},
                           {bench, "garden", "post", 320, 200, samples}}) {
    const Changes changes = changes_of(film, frames);
    table.rows.push_back(changes.row(film.name()));
    plot.series.push_back(changes.literal_line);
    plot.series.push_back(changes.whole_line);
  }
  write_plot(bench.folder + "/truth-motion.png", plot);
  section.tables.push_back(table);
  section.figures.push_back({"truth-motion.png", "A fence before a portrait, grass and lamps."});
}

}  // namespace defray::perf
