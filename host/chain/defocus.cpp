#include "chain/defocus.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "chain/assemble.h"
#include "chain/patterns.h"
#include "chain/stages.h"
#include "lens/aperture_table.h"
#include "lens/cats_eye.h"
#include "lens/lens_samples.h"
#include "measure/metrics.h"
#include "methods/method.h"
#include "reference/reference.h"
#include "reference/stages.h"

namespace defray {
namespace {

using Words = std::vector<std::uint32_t>;
using Clock = std::chrono::steady_clock;

/// The chain, stage by stage.
class Chain {
 public:
  Chain(const DefocusSettings& settings, const RdbSettings& rdb, Session* session)
      : settings_(settings), rdb_(rdb), session_(session) {}

  DefocusResult run(const PinholeFrame& frame, const std::function<void(double)>& progress) {
    mask_ = rasterise(settings_.aperture);
    const int points =
        static_cast<int>(make_lens_cells(settings_.cells_per_side, false).centres.size());
    rdb_.samples = make_lens_samples(settings_.aperture, points);
    report_.lens_points = points;
    ExtendedFrame e = extend(frame, settings_.border, rdb_.wants_nearest, report_);
    done("border");
    if (settings_.repair_depth) repair_depth(e);
    Fragments fragments = make_fragments(e);
    const LightSources lights = take_highlights(
        fragments, static_cast<int>(frame.channels.size()) - (frame.has_alpha ? 1 : 0));
    if (settings_.border == Border::clamp) continue_colours(e, fragments);
    if (settings_.soften) fragments.channels = soften(fragments, points);
    done("soften");
    place(e, frame);
    RdbResult result = distribute(fragments, lights, progress);
    fragments = {};
    done("rays");
    DefocusResult out = finish(e, std::move(result));
    if (frame.has_alpha) limit_alpha(frame.channels.back(), out.colour);
    return out;
  }

 private:
  void done(const char* stage) {
    const auto now = Clock::now();
    report_.stages.push_back({stage, std::chrono::duration<double>(now - start_).count()});
    start_ = now;
  }

  /// Depth that was anti-aliased has many pixels between two surfaces: of the built-in scenes' edge
  /// pixels one in 3 to 15, at 320 x 240 and larger (`cutout`, before nothing, one in 40).
  /// Otherwise it is one in 28 or less: wires.
  void repair_depth(ExtendedFrame& e) {
    const Words source = session_
                             ? repair(*session_, e.width, e.height, e.coc_quanta, rdb_.memory_bytes)
                             : reference::repair(e.width, e.height, e.coc_quanta);
    const Words mixed = find_edges(e);
    std::size_t between = 0, edge = 0;
    for (std::size_t i = 0; i < source.size(); ++i) {
      between += source[i] != i;
      edge += mixed[i];
    }
    constexpr std::size_t mixed_a_ramp = 20;
    if (between * mixed_a_ramp >= edge && between > 0) {
      const std::vector<std::int32_t> coc = e.coc_quanta;
      const Plane inverse = e.inverse;
      const Words data = e.data;
      for (std::size_t i = 0; i < source.size(); ++i) {
        e.coc_quanta[i] = coc[source[i]];
        e.inverse[i] = inverse[source[i]];
        if (!data.empty()) e.data[i] = data[source[i]];
        report_.repaired += source[i] != i && !e.is_in_margin(i);
      }
    }
    done("repair");
  }

  Words find_edges(const ExtendedFrame& e) const {
    return session_ ? edges(*session_, e.width, e.height, e.coc_quanta, rdb_.memory_bytes)
                    : reference::edges(e.width, e.height, e.coc_quanta);
  }

  Fragments make_fragments(ExtendedFrame& e) {
    const FrameView view = e.view();
    const Words mixed = find_edges(e);
    done("edges");
    if (settings_.hidden == Hidden::off ||
        std::find(mixed.begin(), mixed.end(), 1u) == mixed.end()) {
      return whole_pixels(e);
    }
    Surface behind =
        session_ ? fill(*session_, view, mixed, rdb_.memory_bytes) : reference::fill(view, mixed);
    done("fill");
    if (settings_.hidden == Hidden::on) add_patterns(e, mixed, behind);
    // Without `split` no pixel counts as mixed: all keep their colour and surface.
    const Words to_split = settings_.split_edges ? mixed : Words(mixed.size());
    Surfaces s = session_ ? split(*session_, view, to_split, std::move(behind), rdb_.memory_bytes)
                          : reference::split(view, to_split, std::move(behind));
    done("split");
    return assemble(e, std::move(s), report_);
  }

  void add_patterns(const ExtendedFrame& e, const Words& mixed, Surface& behind) {
    Words is_behind, encoded;
    for (std::size_t i = 0; i < mixed.size(); ++i) {
      is_behind.push_back(behind.inverse[i] >= 0);
      std::uint32_t word = mixed[i] || is_behind[i] || e.is_in_margin(i) ? 0 : DEFRAY_PATTERN_KNOWN;
      for (std::size_t c = 0; c < 3; ++c) {
        const float v = e.channels[std::min(c, e.channels.size() - 1)][i];
        word |= static_cast<std::uint32_t>(std::lround(255 * shown_value(v))) << (8 * c);
      }
      encoded.push_back(word);
    }
    const PatternFrame frame{e.width,           e.height,  encoded,   e.coc_quanta,
                             behind.coc_quanta, is_behind, e.inverse, behind.inverse};
    PatternSettings patterns;
    patterns.shifts = settings_.pattern_shifts;
    patterns.memory_bytes = rdb_.memory_bytes;
    if (session_) {
      improve_by_patterns(*session_, frame, e.channels, patterns, behind.channels);
    } else {
      reference::improve_by_patterns(frame, e.channels, patterns, behind.channels);
    }
    done("patterns");
  }

  LightSources take_highlights(Fragments& f, int light_channels) {
    LightSources lights;
    if (settings_.highlights) {
      Plane kept = session_ ? defray::highlights(*session_, f, light_channels, rdb_.memory_bytes)
                            : reference::highlights(f, light_channels);
      lights = take_light(f, kept, light_channels, make_aperture_table(mask_), rdb_.samples);
      report_.highlights = lights.where.size();
    }
    done("highlights");
    return lights;
  }

  std::vector<Plane> soften(const Fragments& f, int points) const {
    return session_ ? defray::soften(*session_, f, points, rdb_.memory_bytes)
                    : reference::soften(f, points);
  }

  /// Where the frame lies: for what is random, and the lens's rim.
  void place(const ExtendedFrame& e, const PinholeFrame& frame) {
    rdb_.origin_x = frame.origin_x - e.margin;
    rdb_.origin_y = frame.origin_y - e.margin;
    if (settings_.aperture.cats_eye == 0) return;
    const int width = frame.display_width > 0 ? frame.display_width : frame.width;
    const int height = frame.display_height > 0 ? frame.display_height : frame.height;
    const auto rim = [&](int x, int y) {
      return rim_centre(settings_.aperture.cats_eye, rdb_.origin_x + x + 0.5,
                        rdb_.origin_y + y + 0.5, width, height);
    };
    for (int x = 0; x < e.width; ++x) rdb_.rim_x.push_back(rim(x, 0)[0]);
    for (int y = 0; y < e.height; ++y) rdb_.rim_y.push_back(rim(0, y)[1]);
  }

  RdbResult distribute(const Fragments& f, const LightSources& lights,
                       const std::function<void(double)>& progress) const {
    const FragmentView view(f);
    return session_ ? distribute_rays(*session_, view, rdb_, &lights, progress)
                    : reference::distribute_rays(view, rdb_, &lights, progress);
  }

  /// Discs and rays of one surface meet along other borders than pixels do: a little more than all
  /// of it can come together. Light and alpha give way alike, so that colour stays premultiplied.
  static void limit_alpha(const Plane& pinhole, std::vector<Plane>& colour) {
    float most = 0;
    for (const float a : pinhole) most = std::fmax(most, a);
    for (std::size_t i = 0; i < pinhole.size(); ++i) {
      const float alpha = colour.back()[i];
      if (!(alpha > most * 1.000001f)) continue;
      for (Plane& plane : colour) plane[i] *= most / alpha;
    }
  }

  DefocusResult finish(const ExtendedFrame& e, RdbResult result) {
    DefocusResult out;
    for (const Plane& plane : result.means) out.colour.push_back(cropped(plane, e));
    const Words seen = cropped(result.seen, e);
    const int width = e.width - 2 * e.margin;
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const std::size_t open = open_cells(rdb_, rdb_.samples, i % size(width) + size(e.margin),
                                          i / size(width) + size(e.margin));
      out.confidence.push_back(open == 0 ? 0.0f
                                         : static_cast<float>(seen[i]) / static_cast<float>(open));
      sum += out.confidence.back();
    }
    if (rdb_.wants_nearest) out.nearest = or_own_pixel(cropped(result.nearest, e));
    report_.confidence = sum / static_cast<double>(seen.size());
    done("crop");
    out.report = std::move(report_);
    return out;
  }

  const DefocusSettings& settings_;
  RdbSettings rdb_;
  Session* session_;
  ApertureMask mask_;
  DefocusReport report_;
  Clock::time_point start_ = Clock::now();
};

/// The host holds whole frames between stages: about so many bytes a pixel in all, measured.
constexpr std::size_t bytes_a_pixel = 200;

/// Of host memory only a device that shares it tells how much there is.
void require_memory(const PinholeFrame& frame, const DeviceInfo& device) {
  const std::size_t needed = size(frame.width) * size(frame.height) * bytes_a_pixel;
  if (!device.shares_host_memory || needed <= device.global_memory_bytes) return;
  fail(
      ErrorKind::device,
      "{}x{} pixels: the stages of rdb need about {} MiB of host memory, {} has {} MiB; {} needs a "
      "third",
      frame.width, frame.height, needed >> 20, device.name, device.global_memory_bytes >> 20,
      field("literal"));
}

}  // namespace

DefocusSettings settings_for(Quality quality) {
  DefocusSettings s;
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

DefocusResult defocus(const PinholeFrame& frame, const DefocusSettings& settings,
                      const RdbSettings& rdb, Session* session,
                      const std::function<void(double)>& progress) {
  if (session) require_memory(frame, session->info());
  return Chain(settings, rdb, session).run(frame, progress);
}

}  // namespace defray
