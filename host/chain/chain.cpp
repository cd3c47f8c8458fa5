#include "chain/chain.h"

#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "chain/border.h"
#include "chain/highlights.h"
#include "chain/layers.h"
#include "chain/patterns.h"
#include "chain/ray_plan.h"
#include "kernels/params.h"
#include "lens/aperture_table.h"

namespace defray {
namespace {

/// What each stage of the chain does, and what it leaves for those after it and for the report.
class Chain {
 public:
  Chain(const ChainSettings& settings, Backend& backend) : settings_(settings), backend_(backend) {}

  void plan_lens(bool wants_nearest) {
    plan_ = ray_plan(settings_, wants_nearest);
    report_.lens_points = static_cast<int>(plan_.lens.points.size());
    done("lens");
  }

  Frame extend(const Frame& frame) {
    Frame f = extended(frame, settings_.border, plan_.wants_nearest, report_);
    done("border");
    return f;
  }

  /// Depth that was anti-aliased has many pixels between two surfaces: of the built-in scenes' edge
  /// pixels one in 3 to 15, at 320 x 240 and larger (`cutout`, before nothing, one in 40).
  /// Otherwise it is one in 28 or less: wires. Returns where pixels are mixed.
  Words repair(Frame& f) {
    Words mixed = backend_.mixed(f);
    done("mixed");
    if (!settings_.repair) return mixed;
    const Words repaired = backend_.repair(f);
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
    if (is_antialiased) mixed = backend_.mixed(f);
    done("mixed");
    return mixed;
  }

  void classify(const Frame& f, const Words& mixed) {
    tiles_ = TileClasses(f);
    tiles_.add_mixed(mixed);
    done("tiles");
  }

  Frame find_surfaces(Frame f, const Words& mixed) {
    const bool has_edges = std::find(mixed.begin(), mixed.end(), 1u) != mixed.end();
    if (settings_.hidden == Hidden::off || !has_edges) return whole_pixels(std::move(f));
    // Where patterns add their detail twice as many directions are worth their time; without them
    // the mean of fewer is as close to the truth (perf/README.md).
    const int directions = settings_.hidden == Hidden::patterns ? DEFRAY_FILL_DIRECTIONS : 8;
    Frame behind = backend_.fill(f, mixed, directions);
    done("fill");
    tiles_.add_hidden(behind.inverse);
    done("tiles");
    if (settings_.hidden == Hidden::patterns) add_patterns(f, mixed, behind);
    // Without `split` no pixel counts as mixed: all keep their colour and surface.
    const Words to_split = settings_.split ? mixed : Words(mixed.size());
    const Surfaces surfaces = backend_.split(f, to_split, std::move(behind));
    f = two_layers(backend_, f, surfaces, report_);
    done("split");
    return f;
  }

  LightSources take_highlights(Frame& f) {
    LightSources lights;
    if (settings_.highlights) {
      const int light_channels = static_cast<int>(f.channels.size()) - (f.has_alpha ? 1 : 0);
      const Values<float> kept = backend_.highlights(f, light_channels);
      const auto is_light = [](float share) { return share != 1.0f; };
      if (std::any_of(kept.begin(), kept.end(), is_light)) {
        const ApertureTable table = make_aperture_table(rasterise(settings_.aperture));
        lights = take_light(f, kept, light_channels, table, plan_.lens);
      }
      report_.highlights = lights.where.size();
      tiles_.add(lights);
    }
    done("highlights");
    return lights;
  }

  void prepare_colours(Frame& f) {
    if (settings_.border == Border::clamp) continue_colours(f);
    done("border");
    if (settings_.soften) f.channels = backend_.soften(f, report_.lens_points);
    done("soften");
  }

  RayResult send_rays(const Frame& f, const LightSources& lights, const Progress& progress) {
    place_rays(f, settings_.aperture.cats_eye, plan_);
    done("lens");
    RayResult result = backend_.rays(f, plan_, &lights, progress);
    done("rays");
    return result;
  }

  /// The picture that `frame`, which became `f`, gives.
  MethodResult finish(const Frame& frame, const Frame& f, RayResult result) {
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
    const std::size_t made = backend_.bytes_made(), bytes = made - bytes_;
    bytes_ = made;
    if (found == report_.stages.end()) {
      report_.stages.push_back({stage, seconds, bytes});
    } else {
      found->seconds += seconds;
      found->bytes += bytes;
    }
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

  void add_patterns(const Frame& f, const Words& mixed, Frame& behind) {
    std::vector<bool> is_behind(f.pixels());
    const auto inverse = behind.inverse.host();
    for (std::size_t i = 0; i < inverse.size(); ++i) is_behind[i] = inverse[i] >= 0;
    const Words pixels = patterns_pixels(encoded_colours(f, behind, mixed), f.channels, is_behind);
    PatternSettings patterns;
    patterns.shifts = settings_.pattern_shifts;
    improve_by_patterns(backend_, f, pixels, patterns, behind);
    done("patterns");
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
  Backend& backend_;
  RayPlan plan_;
  ChainReport report_;
  TileClasses tiles_;
  std::size_t bytes_ = backend_.bytes_made();
  Stopwatch watch_;
};

/// The host holds whole frames: about so many bytes a pixel in all, measured.
constexpr std::size_t bytes_a_pixel = 200;

}  // namespace

MethodResult run_chain(const Frame& frame, const ChainSettings& settings, Backend& backend,
                       bool wants_nearest, const Progress& progress) {
  backend.require_memory(frame, frame.pixels() * bytes_a_pixel);
  Chain chain(settings, backend);
  chain.plan_lens(wants_nearest);
  Frame f = chain.extend(frame);
  const Words mixed = chain.repair(f);
  chain.classify(f, mixed);
  f = chain.find_surfaces(std::move(f), mixed);
  const LightSources lights = chain.take_highlights(f);
  chain.prepare_colours(f);
  RayResult result = chain.send_rays(f, lights, progress);
  return chain.finish(frame, f, std::move(result));
}

}  // namespace defray
