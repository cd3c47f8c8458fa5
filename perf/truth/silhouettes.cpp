// Where results show edges that the truth has not: their worst places, whatever they are.
#include <algorithm>
#include <array>

#include "experiments.h"
#include "measure/false_edges.h"
#include "measure/metrics.h"
#include "truth/places.h"
#include "truth/truth.h"

namespace defray::perf {
namespace {

/// Of each setting so many places, so large, shown so many times as large.
constexpr int shown_places = 2, crop_width = 120, crop_height = 90, zoom = 3;

using NamedPictures = std::vector<std::pair<std::string, std::vector<Plane>>>;

struct Window {
  int x, y, width, height;
};

/// Around a pixel, within a picture of some size.
Window window_around(int x, int y, int width, int height) {
  const int w = std::min(crop_width, width), h = std::min(crop_height, height);
  return {std::clamp(x - w / 2, 0, width - w), std::clamp(y - h / 2, 0, height - h), w, h};
}

std::vector<Plane> enlarged(const std::vector<Plane>& picture, int width, const Window& w) {
  std::vector<Plane> large;
  for (const Plane& plane : picture) {
    Plane& to = large.emplace_back();
    for (int y = 0; y < w.height * zoom; ++y) {
      for (int x = 0; x < w.width * zoom; ++x) {
        to.push_back(plane[static_cast<std::size_t>((w.y + y / zoom) * width + w.x + x / zoom)]);
      }
    }
  }
  return large;
}

/// Puts another picture's window into one.
void copy_window(const std::vector<Plane>& from, std::vector<Plane>& to, int width,
                 const Window& w) {
  for (std::size_t c = 0; c < to.size(); ++c) {
    for (int y = w.y; y < w.y + w.height; ++y) {
      std::copy_n(from[c].begin() + y * width + w.x, w.width, to[c].begin() + y * width + w.x);
    }
  }
}

std::vector<MeasuredPlace> builtin_places(const Bench& bench) {
  constexpr std::array<std::array<const char*, 2>, 9> all{{{"cutout", "far"},
                                                           {"lines", "default"},
                                                           {"fence", "bg"},
                                                           {"fence", "fence"},
                                                           {"drift", "face"},
                                                           {"garden", "grass"},
                                                           {"garden", "post"},
                                                           {"spheres", "f2"},
                                                           {"plate1", "default"}}};
  std::vector<MeasuredPlace> places;
  for (const auto& [scene, setting] : all) {
    Setup setup = make_setup(bench, scene, setting, 640, 400);
    places.push_back({setup.name(), std::move(setup.subject), std::move(setup.truth.colour)});
  }
  return places;
}

/// Crops of all pictures, and the truth, where the last one is worst.
void add_crops(const Bench& bench, const MeasuredPlace& place, const NamedPictures& pictures,
               Section& section) {
  const int width = place.subject.scene.width, height = place.subject.scene.height;
  std::vector<Plane> left = pictures.back().second;
  for (int i = 1; i <= shown_places; ++i) {
    const Excess excess = false_edges(left, place.truth, width);
    if (!(excess.worst > 0)) return;
    const Window w = window_around(excess.worst_x, excess.worst_y, width, height);
    NamedPictures crops;
    for (const auto& [name, picture] : pictures) {
      crops.emplace_back(name, enlarged(picture, width, w));
    }
    crops.emplace_back("truth", enlarged(place.truth, width, w));
    std::vector<std::pair<std::string, const std::vector<Plane>*>> shown;
    for (const auto& [name, crop] : crops) shown.emplace_back(name, &crop);
    // A given scene may have a built-in one's name.
    std::string file = fmt::format("silhouettes-{}-{}", section.figures.size() + 1, place.name);
    std::replace(file.begin(), file.end(), ' ', '-');
    section.figures.push_back(
        sheet(bench, file,
              fmt::format("{}, {}x{}+{}+{}: worst {}, {} 255ths a pixel", place.name, w.width,
                          w.height, w.x, w.y, i, fixed(excess.worst, 1)),
              shown, w.width * zoom, w.height * zoom));
    copy_window(place.truth, left, width, w);
  }
}

/// The pinhole picture, other methods' and, last, the default's.
NamedPictures pictures_of(const Bench& bench, const MeasuredPlace& place) {
  const auto rendered = [&](const MethodSettings& settings) {
    return render(bench.backend, place.subject, settings);
  };
  return {{"pinhole", place.subject.pinhole.colour},
          {"literal RDB 9x9", rendered(rdb_of(9))},
          {"gather aware 32x2", rendered(gather_of(GatherKind::aware, 32, 2))},
          {"default", rendered(default_chain())}};
}

std::vector<std::string> row_of(const MeasuredPlace& place, const NamedPictures& pictures) {
  std::vector<std::string> row{place.name};
  const int width = place.subject.scene.width;
  for (const auto& [name, picture] : pictures) {
    const Excess excess = false_edges(picture, place.truth, width);
    row.push_back(fmt::format("{:.3f}, {:.2f}; {:.2f} dB", excess.rms, excess.p999,
                              compare(picture, place.truth, width).psnr_srgb_db));
  }
  return row;
}

}  // namespace

Section silhouettes(const Bench& bench) {
  Table table{"silhouettes",
              "False edges: gradients of sRGB luma above the largest of the truth within 2 px, "
              "255ths a pixel: RMS, 99.9th percentile; and PSNR, sRGB dB",
              {"scene"},
              {}};
  Section section{"Edges that are not there",
                  "What a near thing hides has a shape, too. Where that is guessed wrongly, or cut "
                  "off, a blurred edge shows a crisp one. Here are the places where the default "
                  "does worst, not chosen by anybody.",
                  {},
                  {},
                  {}};
  std::vector<MeasuredPlace> places = builtin_places(bench);
  for (MeasuredPlace& place : read_places(bench)) places.push_back(std::move(place));
  for (const MeasuredPlace& place : places) {
    bench.step(place.name);
    const NamedPictures pictures = pictures_of(bench, place);
    if (table.rows.empty()) {
      for (const auto& [name, picture] : pictures) table.columns.push_back(name);
    }
    table.rows.push_back(row_of(place, pictures));
    add_crops(bench, place, pictures, section);
  }
  section.tables.push_back(table);
  return section;
}

}  // namespace defray::perf
