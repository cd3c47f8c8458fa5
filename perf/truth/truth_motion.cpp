// A fence drifting before a portrait: what changes from frame to frame beside what should.
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
  std::string setting;
  int samples;

  Subject subject(int frame) const {
    return make_antialiased(bench.backend,
                            make_scene("drift", bench.size(160), bench.size(120), frame), setting);
  }
  /// `seed`: another one gives other noise.
  std::vector<Plane> truth(const Subject& s, int seed) const {
    return render_truth(s.scene, s.lens, samples, static_cast<std::uint32_t>(seed)).colour;
  }
  Moment moment(int frame) const {
    bench.step(fmt::format("drift {}: frame {}", setting, frame));
    const Subject s = subject(frame);
    return {s.pinhole.colour, truth(s, frame), render(bench.backend, s, rdb_of(9)),
            render(bench.backend, s, default_chain())};
  }
};

struct Mean {
  double sum = 0;
  int count = 0;
  void add(double value) { sum += value, ++count; }
  std::string text() const { return fixed(255 * sum / count); }
};

}  // namespace

void add_motion(const Bench& bench, Section& section) {
  const int frames = bench.is_quick ? 3 : 24;
  Table table{
      "truth-motion",
      fmt::format("drift, {} frames, {} x {}: RMS change from frame to frame, sRGB, in 255ths: "
                  "the truth's own, and by how much the methods' change is another",
                  frames, bench.size(160), bench.size(120)),
      {"focus", "truth's change", "pinhole", "literal RDB 9x9", "default",
       "truth with other noise"},
      {}};
  Plot plot{"drift: change from frame to frame beside the truth's", "frame", "RMS, sRGB, 255ths"};
  for (const std::string setting : {"face", "fence"}) {
    const Film film{bench, setting, bench.is_quick ? 9 : 100};
    Moment before = film.moment(1);
    Mean change, pinhole, literal, whole;
    Series literal_line{setting + ": literal", {}}, whole_line{setting + ": default", {}};
    for (int frame = 2; frame <= frames; ++frame) {
      Moment now = film.moment(frame);
      const auto error = [&](const std::vector<Plane>& a, const std::vector<Plane>& b) {
        return flicker(a, b, before.truth, now.truth);
      };
      const Flicker of_literal = error(before.literal, now.literal);
      const Flicker of_whole = error(before.whole, now.whole);
      change.add(of_whole.truth_rms);
      pinhole.add(error(before.pinhole, now.pinhole).error_rms);
      literal.add(of_literal.error_rms);
      whole.add(of_whole.error_rms);
      literal_line.points.push_back({double(frame), 255 * of_literal.error_rms});
      whole_line.points.push_back({double(frame), 255 * of_whole.error_rms});
      before = std::move(now);
    }
    Mean noise;
    const Subject first = film.subject(1), second = film.subject(2);
    noise.add(flicker(film.truth(first, 101), film.truth(second, 102), film.truth(first, 1),
                      film.truth(second, 2))
                  .error_rms);
    table.rows.push_back(
        {setting, change.text(), pinhole.text(), literal.text(), whole.text(), noise.text()});
    plot.series.push_back(literal_line);
    plot.series.push_back(whole_line);
  }
  write_plot(bench.folder + "/truth-motion.png", plot);
  section.tables.push_back(table);
  section.figures.push_back({"truth-motion.png", "A fence drifting before a portrait."});
}

}  // namespace defray::perf
