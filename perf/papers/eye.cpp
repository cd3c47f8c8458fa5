// Glatzel & Wilhelm, figures 8 and 9: the block world from 75 m, as the eye sees it and as if it
// were 6 cm away; against the truth and against the vertical blur of a photo editor. Their method's
// artefacts, measured, and the cost of the effect.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "experiments.h"
#include "lens/coc.h"
#include "measure/metrics.h"
#include "methods/tiltshift.h"

namespace defray::perf {
namespace {

struct View {
  Subject subject;
  std::vector<Plane> truth, literal, aware, tiltshift, rdb;
};

double mean_radius_px(const Subject& s, int row) {
  double sum = 0;
  for (int x = 0; x < s.scene.width; ++x) {
    sum += std::fabs(s.coc[static_cast<std::size_t>(row * s.scene.width + x)]) * px_per_quantum;
  }
  return sum / s.scene.width;
}

/// The gradient that the paper's authors drew by eye from the CoC picture: sharp where a row's mean
/// radius is below half a pixel, the largest row's mean at the farthest edge.
TiltshiftSettings estimate_gradient(const Subject& s) {
  const int height = s.scene.height;
  int sharpest = 0, first = height, last = -1;
  for (int y = 0; y < height; ++y) {
    if (mean_radius_px(s, y) < mean_radius_px(s, sharpest)) sharpest = y;
    if (mean_radius_px(s, y) >= 0.5) continue;
    first = std::min(first, y);
    last = std::max(last, y);
  }
  if (last < 0) first = last = sharpest;
  const double centre = 0.5 * (first + last + 1) / height;
  const int edge = centre > 0.5 ? 0 : height - 1;
  return {centre, static_cast<double>(last - first + 1) / height, mean_radius_px(s, edge)};
}

std::vector<Plane> render_tiltshift(Backend& backend, const Subject& s) {
  const auto p =
      tiltshift_params(estimate_gradient(s), s.scene.width, s.scene.height, 0, s.scene.height);
  Frame frame = s.frame();
  frame.coc_quanta = backend.tiltshift(p);
  MethodSettings tiltshift_method;
  tiltshift_method.method = Method::tiltshift;
  return apply_method(frame, tiltshift_method, backend).colour;
}

View render_view(const Bench& bench, const std::string& name) {
  bench.step(name + ": truth");
  View v{
      make_subject(bench.backend, make_scene(name, bench.size(960), bench.size(600)), "miniature"),
      {},
      {},
      {},
      {},
      {}};
  v.truth = render_truth(v.subject.scene, v.subject.lens, bench.is_quick ? 16 : 128, 1).colour;
  bench.step(name + ": filters");
  v.literal = render(bench.backend, v.subject, gather_of(GatherKind::literal, 32, 2));
  v.aware = render(bench.backend, v.subject, gather_of(GatherKind::aware, 32, 2));
  v.rdb = render(bench.backend, v.subject, rdb_of(17));
  v.tiltshift = render_tiltshift(bench.backend, v.subject);
  return v;
}

/// Pixels by what the paper's artefacts do to them.
enum Region : std::uint8_t {
  elsewhere,
  sharp,      ///< CoC under half a pixel.
  near_edge,  ///< Last pixel of a blurred nearer surface before a farther one to its right or
              ///< below.
  glow,       ///< Blurred, with a sharp pixel within its CoC.
};

std::vector<std::uint8_t> regions_of(const Subject& s) {
  const int width = s.scene.width, height = s.scene.height;
  const auto radius = [&](int x, int y) {
    return static_cast<float>(s.coc[static_cast<std::size_t>(y * width + x)]) * px_per_quantum;
  };
  const auto sees_sharp = [&](int x, int y) {
    const int reach = static_cast<int>(std::fabs(radius(x, y)));
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, height - 1); ++j) {
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, width - 1); ++i) {
        if (std::fabs(radius(i, j)) < 0.5f && std::hypot(i - x, j - y) <= reach) return true;
      }
    }
    return false;
  };
  std::vector<std::uint8_t> regions(s.coc.size(), elsewhere);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float own = radius(x, y);
      const float right = radius(std::min(x + 1, width - 1), y);
      auto& region = regions[static_cast<std::size_t>(y * width + x)];
      if (std::fabs(own) < 0.5f)
        region = sharp;
      else if (own < -1 && right - own > 1)
        region = near_edge;
      else if (sees_sharp(x, y))
        region = glow;
    }
  }
  return regions;
}

/// Mean step from a near edge's pixel to its right neighbour, G.
double edge_step(const View& v, const std::vector<Plane>& picture,
                 const std::vector<std::uint8_t>& regions) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i + 1 < regions.size(); ++i) {
    if (regions[i] != near_edge || (i + 1) % static_cast<std::size_t>(v.subject.scene.width) == 0) {
      continue;
    }
    sum += std::fabs(static_cast<double>(picture[1][i + 1] - picture[1][i]));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

Table artefacts(const View& v, const std::string& name) {
  Table table{"eye-" + name,
              name + " seen from 6 cm: error against the truth, and the paper's artefacts",
              {"method", "PSNR sRGB dB", "SSIM", "step at near edges / truth's",
               "RMS in sharp pixels", "RMS in blurred pixels beside sharp ones"},
              {}};
  const auto regions = regions_of(v.subject);
  const double true_step = edge_step(v, v.truth, regions);
  const auto add = [&](const std::string& method, const std::vector<Plane>& picture) {
    const Comparison c = compare(picture, v.truth, v.subject.scene.width);
    table.rows.push_back({method, fixed(c.psnr_srgb_db), fixed(c.ssim, 4),
                          true_step > 0 ? fixed(edge_step(v, picture, regions) / true_step) : "-",
                          fixed(errors_where(picture, v.truth, regions, sharp).rms, 4),
                          fixed(errors_where(picture, v.truth, regions, glow).rms, 4)});
  };
  add("pinhole", v.subject.pinhole.colour);
  add("gather literal, 32 x 2", v.literal);
  add("gather aware, 32 x 2", v.aware);
  add("RDB 17x17", v.rdb);
  add("tilt-shift", v.tiltshift);
  return table;
}

/// Seconds for copying a frame's three planes.
Timing time_copy(const Bench& bench, const std::vector<Plane>& planes) {
  std::vector<Plane> copy = planes;
  return time_of(5 * bench.repetitions(), [&] {
    for (std::size_t c = 0; c < planes.size(); ++c) {
      std::memcpy(copy[c].data(), planes[c].data(), planes[c].size() * sizeof(float));
    }
  });
}

Table cost(const Bench& bench, Section& section) {
  bench.step("cost at 1920 x 1200");
  const Subject s = make_subject(
      bench.backend, make_scene("blocks-lake", bench.size(1920), bench.size(1200)), "miniature");
  const Timing copy = time_copy(bench, s.pinhole.colour);
  Table table{
      "eye-cost",
      fmt::format("Cost at {} x {}, 32 samples, 2 passes", bench.size(1920), bench.size(1200)),
      {"what", "time", "copies of the frame"},
      {}};
  table.rows.push_back({"copy of the frame", to_text(copy), "1"});
  for (const auto& [name, kind] : {std::pair{"gather literal", GatherKind::literal},
                                   std::pair{"gather aware", GatherKind::aware}}) {
    const Timing t = time_method(bench, s, gather_of(kind, 32, 2));
    table.rows.push_back({name, to_text(t), fixed(t.median_s / copy.median_s, 0)});
    section.findings.push_back(
        fmt::format("At 1920 x 1200, {} with 32 samples and 2 passes costs {:.0f} "
                    "copies of the frame.",
                    name, t.median_s / copy.median_s));
  }
  return table;
}

void add_view(const Bench& bench, const std::string& name, Section& section) {
  const View v = render_view(bench, name);
  const int width = v.subject.scene.width, height = v.subject.scene.height;
  const auto literal_difference = difference_picture(v.literal, v.truth, 4);
  const auto aware_difference = difference_picture(v.aware, v.truth, 4);
  const auto paper_difference = difference_picture(v.literal, v.tiltshift, 4);
  section.tables.push_back(artefacts(v, name));
  const auto& rows = section.tables.back().rows;
  section.findings.push_back(
      fmt::format("{}: gather literal {} dB, aware {}, RDB {}, vertical blur {}; RMS in blurred "
                  "pixels beside sharp ones {}, {}, {}, {}.",
                  name, rows[1][1], rows[2][1], rows[3][1], rows[4][1], rows[1][5], rows[2][5],
                  rows[3][5], rows[4][5]));
  const TiltshiftSettings g = estimate_gradient(v.subject);
  section.figures.push_back(sheet(
      bench, "eye-" + name,
      fmt::format("{}: the tilt-shift's band is centred at {:.2f} of the height, {:.2f} high, its "
                  "largest radius {:.1f} px",
                  name, g.band_centre, g.band_width, g.max_blur_px),
      {{"from 75 m", &v.subject.pinhole.colour},
       {"from 6 cm: gather literal", &v.literal},
       {"gather aware", &v.aware}},
      width, height));
  section.figures.push_back(sheet(
      bench, "eye-" + name + "-truth", name + ": truth and baseline",
      {{"truth", &v.truth}, {"RDB 17x17", &v.rdb}, {"vertical blur (tilt-shift)", &v.tiltshift}},
      width, height));
  section.figures.push_back(
      sheet(bench, "eye-" + name + "-difference",
            name + ": differences of sRGB values, 4 times amplified; white is equal",
            {{"literal against truth", &literal_difference},
             {"aware against truth", &aware_difference},
             {"literal against tilt-shift (the paper's figure 9)", &paper_difference}},
            width, height));
}

}  // namespace

Section eye(const Bench& bench) {
  Section section{
      "The eye and perceived scale",
      "Glatzel & Wilhelm: seen with a lens of 5.75 m, a landscape 75 m away looks 6 cm away. The "
      "effect costs little (52 to 51 frames a second at 1920 x 1200 on a Radeon 5870). Foreground "
      "edges stay hard, colours bleed between planes, sharp things glow; the vertical blur of a "
      "photo "
      "editor differs little, but blurs tree tops that are in focus.",
      {},
      {},
      {}};
  add_view(bench, "blocks-lake", section);
  add_view(bench, "blocks-forest", section);
  section.tables.push_back(cost(bench, section));
  return section;
}

}  // namespace defray::perf
