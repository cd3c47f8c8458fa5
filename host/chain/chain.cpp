#include "chain/chain.h"

#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "chain/border.h"
#include "chain/highlights.h"
#include "chain/layers.h"
#include "chain/patterns.h"
#include "kernels/params.h"
#include "lens/aperture_table.h"
#include "lens/cats_eye.h"
#include "lens/lens_samples.h"
#include "rdb/rdb.h"

namespace defray {
namespace {

/// The chain, stage by stage.
class Chain {
 public:
  Chain(const ChainSettings& settings, Stages& stages) : settings_(settings), stages_(stages) {}

  MethodResult run(const Frame& frame, bool wants_nearest, const Progress& progress) {
    plan_lens(wants_nearest);
    Frame f = extended(frame, settings_.border, wants_nearest, report_);
    done("border");
    const Words mixed = repair_depth(f);
    tiles_ = TileClasses(f);
    tiles_.add_edges(mixed);
    done("tiles");
    f = find_surfaces(std::move(f), mixed);
    const LightSources lights = take_highlights(f);
    tiles_.add(lights);
    if (settings_.border == Border::clamp) continue_colours(f);
    done("border");
    if (settings_.soften) f.channels = stages_.soften(f, report_.lens_points);
    done("soften");
    plan_rim(f);
    done("lens");
    RayResult result = stages_.rays(f, plan_, &lights, progress);
    done("rays");
    MethodResult out = crop(f, std::move(result));
    if (frame.has_alpha) limit_alpha(frame.channels.back(), out.colour);
    report_.tiles = tiles_.shares();
    out.tiles = std::move(tiles_);
    done("crop");
    out.report = std::move(report_);
    return out;
  }

 private:
  /// A stage that comes back adds to its time.
  void done(const char* stage) {
    const double seconds = watch_.lap();
    const auto found = std::find_if(report_.stages.begin(), report_.stages.end(),
                                    [&](const StageTime& s) { return s.stage == stage; });
    const std::size_t made = stages_.bytes_made(), bytes = made - bytes_;
    bytes_ = made;
    if (found == report_.stages.end()) {
      report_.stages.push_back({stage, seconds, bytes});
    } else {
      found->seconds += seconds;
      found->bytes += bytes;
    }
  }

  void plan_lens(bool wants_nearest) {
    validate(settings_.aperture);
    const auto points = make_lens_cells(settings_.cells_per_side, false).centres.size();
    report_.lens_points = static_cast<int>(points);
    plan_.cells = make_lens_samples(settings_.aperture, report_.lens_points);
    plan_.wants_nearest = wants_nearest;
    plan_.by = settings_.rays;
    done("lens");
  }

  /// Depth that was anti-aliased has many pixels between two surfaces: of the built-in scenes' edge
  /// pixels one in 3 to 15, at 320 x 240 and larger (`cutout`, before nothing, one in 40).
  /// Otherwise it is one in 28 or less: wires. Returns where pixels are mixed.
  Words repair_depth(Frame& f) {
    Words mixed = stages_.edges(f);
    done("edges");
    if (!settings_.repair_depth) return mixed;
    const Words repaired = stages_.repair(f);
    const auto source = repaired.host();
    std::size_t between = 0;
    for (std::size_t i = 0; i < source.size(); ++i) between += source[i] != i;
    const auto edge = static_cast<std::size_t>(std::count(mixed.begin(), mixed.end(), 1u));
    constexpr std::size_t mixed_a_ramp = 20;
    const bool is_antialiased = between * mixed_a_ramp >= edge && between > 0;
    if (is_antialiased) {
      move_surfaces(f, source);
      for (std::size_t i = 0; i < source.size(); ++i) {
        report_.repaired += source[i] != i && !f.is_in_margin(i);
      }
    }
    done("repair");
    if (is_antialiased) mixed = stages_.edges(f);
    done("edges");
    return mixed;
  }

  /// Gives each pixel another one's CoC, depth and data.
  static void move_surfaces(Frame& f, std::span<const std::uint32_t> source) {
    const auto moved = [&](auto& plane) {
      if (plane.empty()) return;
      auto copy = plane;
      const auto from = copy.host();
      const auto to = plane.edit();
      for (std::size_t i = 0; i < source.size(); ++i) to[i] = from[source[i]];
    };
    moved(f.coc_quanta);
    moved(f.inverse);
    moved(f.data_of);
  }

  Frame find_surfaces(Frame f, const Words& mixed) {
    const bool has_edges = std::find(mixed.begin(), mixed.end(), 1u) != mixed.end();
    if (settings_.hidden == Hidden::off || !has_edges) return whole_pixels(std::move(f));
    // Where patterns add their detail twice as many directions are worth their time; without them
    // the mean of fewer is as close to the truth (perf/README.md).
    const int directions = settings_.hidden == Hidden::on ? DEFRAY_FILL_DIRECTIONS : 8;
    Frame behind = stages_.fill(f, mixed, directions);
    done("fill");
    tiles_.add_hidden(behind.inverse);
    done("tiles");
    if (settings_.hidden == Hidden::on) add_patterns(f, mixed, behind);
    // Without `split` no pixel counts as mixed: all keep their colour and surface.
    const Words to_split = settings_.split_edges ? mixed : Words(mixed.size());
    const Surfaces surfaces = stages_.split(f, to_split, std::move(behind));
    f = two_layers(stages_, f, surfaces, report_);
    done("split");
    return f;
  }

  void add_patterns(const Frame& f, const Words& mixed, Frame& behind) {
    std::vector<bool> is_behind(f.pixels());
    const auto inverse = behind.inverse.host();
    for (std::size_t i = 0; i < inverse.size(); ++i) is_behind[i] = inverse[i] >= 0;
    const Words pixels = pattern_pixels(encoded_colours(f, behind, mixed), f.channels, is_behind);
    PatternSettings patterns;
    patterns.shifts = settings_.pattern_shifts;
    improve_by_patterns(stages_, f, pixels, patterns, behind);
    done("patterns");
  }

  LightSources take_highlights(Frame& f) {
    LightSources lights;
    if (settings_.highlights) {
      const int light_channels = static_cast<int>(f.channels.size()) - (f.has_alpha ? 1 : 0);
      const Values<float> kept = stages_.highlights(f, light_channels);
      const auto is_light = [](float share) { return share != 1.0f; };
      if (std::any_of(kept.begin(), kept.end(), is_light)) {
        const ApertureTable table = make_aperture_table(rasterise(settings_.aperture));
        lights = take_light(f, kept, light_channels, table, plan_.cells);
      }
      report_.highlights = lights.where.size();
    }
    done("highlights");
    return lights;
  }

  /// Where the frame lies: for what is random, and the lens's rim.
  void plan_rim(const Frame& f) {
    plan_.origin_x = f.origin_x;
    plan_.origin_y = f.origin_y;
    if (settings_.aperture.cats_eye == 0) return;
    const int width = f.display_width > 0 ? f.display_width : f.width - 2 * f.margin;
    const int height = f.display_height > 0 ? f.display_height : f.height - 2 * f.margin;
    const auto rim = [&](int x, int y) {
      return rim_centre(settings_.aperture.cats_eye, f.origin_x + x + 0.5, f.origin_y + y + 0.5,
                        width, height);
    };
    for (int x = 0; x < f.width; ++x) plan_.rim_x.push_back(rim(x, 0)[0]);
    for (int y = 0; y < f.height; ++y) plan_.rim_y.push_back(rim(0, y)[1]);
  }

  /// Discs and rays of one surface meet along other borders than pixels do: a little more than all
  /// of it can come together. Light and alpha give way alike, so that colour stays premultiplied.
  static void limit_alpha(const Values<float>& pinhole, std::vector<Plane>& colour) {
    float most = 0;
    for (const float a : pinhole) most = std::fmax(most, a);
    for (std::size_t i = 0; i < pinhole.size(); ++i) {
      const float alpha = colour.back()[i];
      if (!(alpha > most * 1.000001f)) continue;
      for (Plane& plane : colour) plane[i] *= most / alpha;
    }
  }

  MethodResult crop(const Frame& f, RayResult result) {
    MethodResult out;
    const auto part = [&]<typename T>(const std::vector<T>& plane) {
      return cropped(std::span<const T>(plane), f);
    };
    for (Plane& plane : result.means) {
      out.colour.push_back(f.margin > 0 ? part(plane) : std::move(plane));
    }
    const std::vector<std::uint32_t> seen = part(result.seen);
    const std::size_t width = size(f.width - 2 * f.margin), margin = size(f.margin);
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const std::size_t open = open_cells(plan_, i % width + margin, i / width + margin);
      out.confidence.push_back(open == 0 ? 0.0f
                                         : static_cast<float>(seen[i]) / static_cast<float>(open));
      sum += out.confidence.back();
    }
    if (plan_.wants_nearest) out.nearest = or_own_pixel(part(result.nearest));
    report_.confidence = sum / static_cast<double>(seen.size());
    return out;
  }

  const ChainSettings& settings_;
  Stages& stages_;
  RayPlan plan_;
  ChainReport report_;
  TileClasses tiles_;
  std::size_t bytes_ = stages_.bytes_made();
  Stopwatch watch_;
};

/// The host holds whole frames: about so many bytes a pixel in all, measured.
constexpr std::size_t bytes_a_pixel = 200;

}  // namespace

ChainSettings settings_for(Quality quality) {
  ChainSettings s;
  if (quality == Quality::preview) {
    s.cells_per_side = 6;
    s.hidden = Hidden::smooth;
    s.half_size = true;
  }
  if (quality == Quality::draft) {
    s.cells_per_side = 9;
    s.hidden = Hidden::smooth;
  }
  if (quality == Quality::high) {
    s.cells_per_side = 33;
    s.pattern_shifts = 48;
  }
  return s;
}

MethodResult run_chain(const Frame& frame, const ChainSettings& settings, Stages& stages,
                       bool wants_nearest, const Progress& progress) {
  stages.require_memory(frame, frame.pixels() * bytes_a_pixel);
  return Chain(settings, stages).run(frame, wants_nearest, progress);
}

}  // namespace defray
