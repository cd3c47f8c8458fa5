#include "defocus.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

#include "aperture_table.h"
#include "cats_eye.h"
#include "lens_samples.h"
#include "method.h"
#include "metrics.h"
#include "patterns.h"
#include "reference/reference.h"
#include "reference/stages.h"
#include "stages.h"

namespace defray {
namespace {

using Words = std::vector<std::uint32_t>;
using Clock = std::chrono::steady_clock;

std::size_t size(int value) { return static_cast<std::size_t>(value); }

/// A frame with a margin of its own edge pixels.
struct Extended {
  int width, height, margin;
  std::vector<std::int32_t> coc_quanta;
  Plane inverse;
  std::vector<Plane> channels;
  Words data;  ///< The frame's pixel whose data each has; empty if nobody asks.
  FrameView view() const { return {width, height, coc_quanta, inverse, channels}; }
};

/// How far rays come from outside the frame: the largest CoC on its edge. At most half the frame.
int margin_of(const PinholeFrame& f, Border border, DefocusReport& report) {
  if (border == Border::renormalise) return 0;
  std::int32_t largest = 0;
  const auto look = [&](int x, int y) {
    largest = std::max(largest, std::abs(f.coc_quanta[size(y) * size(f.width) + size(x)]));
  };
  for (int x = 0; x < f.width; ++x) look(x, 0), look(x, f.height - 1);
  for (int y = 0; y < f.height; ++y) look(0, y), look(f.width - 1, y);
  const int wanted = largest == 0 ? 0 : rdb_reach(largest);
  const int most = std::max(16, std::min(f.width, f.height) / 2);
  report.border_px = std::min(wanted, most);
  report.border_is_cut = wanted > most;
  return report.border_px;
}

/// `plane` with its edge repeated around it.
template <typename T>
std::vector<T> extended(const std::vector<T>& plane, int width, int height, int margin) {
  std::vector<T> out;
  out.reserve((size(width) + 2 * size(margin)) * (size(height) + 2 * size(margin)));
  for (int y = -margin; y < height + margin; ++y) {
    const T* row = &plane[size(std::clamp(y, 0, height - 1)) * size(width)];
    out.insert(out.end(), size(margin), row[0]);
    out.insert(out.end(), row, row + width);
    out.insert(out.end(), size(margin), row[width - 1]);
  }
  return out;
}

bool is_in_margin(const Extended& e, std::size_t pixel) {
  const int x = static_cast<int>(pixel % size(e.width)),
            y = static_cast<int>(pixel / size(e.width));
  return x < e.margin || y < e.margin || x >= e.width - e.margin || y >= e.height - e.margin;
}

/// Each pixel's own index.
Words own_pixels(int width, int height) {
  Words own(size(width) * size(height));
  std::iota(own.begin(), own.end(), 0u);
  return own;
}

Extended extend(const PinholeFrame& f, Border border, DefocusReport& report) {
  const int margin = margin_of(f, border, report);
  Extended e{f.width + 2 * margin, f.height + 2 * margin, margin, {}, {}, {}, {}};
  e.coc_quanta = extended(f.coc_quanta, f.width, f.height, margin);
  e.inverse = extended(f.depth, f.width, f.height, margin);
  for (float& z : e.inverse) z = std::isinf(z) ? 0.0f : 1.0f / z;
  for (const Plane& plane : f.channels) {
    e.channels.push_back(extended(plane, f.width, f.height, margin));
    for (std::size_t i = 0; border == Border::black && i < e.channels.back().size(); ++i) {
      if (is_in_margin(e, i)) e.channels.back()[i] = 0;
    }
  }
  return e;
}

template <typename T>
std::vector<T> cropped(const std::vector<T>& plane, const Extended& e) {
  std::vector<T> out;
  for (int y = e.margin; y < e.height - e.margin; ++y) {
    const auto row = plane.begin() + static_cast<std::ptrdiff_t>(y) * e.width;
    out.insert(out.end(), row + e.margin, row + e.width - e.margin);
  }
  return out;
}

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
    Extended e = extend(frame, settings_.border, report_);
    if (rdb_.wants_nearest) {
      e.data = extended(own_pixels(frame.width, frame.height), frame.width, frame.height, e.margin);
    }
    done("border");
    if (settings_.repair_depth) repair_depth(e);
    Fragments fragments = make_fragments(e);
    const LightSources lights = take_highlights(
        fragments, static_cast<int>(frame.channels.size()) - (frame.has_alpha ? 1 : 0));
    if (settings_.soften) fragments.channels = soften(fragments, points);
    done("soften");
    place(e, frame);
    RdbResult result = distribute(fragments, lights, progress);
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

  /// Depth that was anti-aliased has many pixels between two surfaces; elsewhere a few are wires.
  void repair_depth(Extended& e) {
    const Words source = session_ ? repair(*session_, e.width, e.height, e.coc_quanta)
                                  : reference::repair(e.width, e.height, e.coc_quanta);
    const Words mixed = find_edges(e);
    std::size_t between = 0, edge = 0;
    for (std::size_t i = 0; i < source.size(); ++i) {
      between += source[i] != i;
      edge += mixed[i];
    }
    constexpr std::size_t mixed_a_ramp = 8;  // an anti-aliased edge has three to four
    if (between * mixed_a_ramp >= edge && between > 0) {
      const std::vector<std::int32_t> coc = e.coc_quanta;
      const Plane inverse = e.inverse;
      const Words data = e.data;
      for (std::size_t i = 0; i < source.size(); ++i) {
        e.coc_quanta[i] = coc[source[i]];
        e.inverse[i] = inverse[source[i]];
        if (!data.empty()) e.data[i] = data[source[i]];
        report_.repaired += source[i] != i && !is_in_margin(e, i);
      }
    }
    done("repair");
  }

  Words find_edges(const Extended& e) const {
    return session_ ? edges(*session_, e.width, e.height, e.coc_quanta)
                    : reference::edges(e.width, e.height, e.coc_quanta);
  }

  Fragments make_fragments(const Extended& e) {
    const FrameView view = e.view();
    const Words mixed = find_edges(e);
    done("edges");
    if (settings_.hidden == Hidden::off ||
        std::find(mixed.begin(), mixed.end(), 1u) == mixed.end()) {
      return whole_pixels(e);
    }
    Surface behind = session_ ? fill(*session_, view, mixed) : reference::fill(view, mixed);
    done("fill");
    if (settings_.hidden == Hidden::on) add_patterns(e, mixed, behind);
    // Without `split` no pixel counts as mixed: all keep their colour and surface.
    const Words to_split = settings_.split_edges ? mixed : Words(mixed.size());
    Surfaces s = session_ ? split(*session_, view, to_split, std::move(behind))
                          : reference::split(view, to_split, std::move(behind));
    done("split");
    return assembled(e, s);
  }

  void add_patterns(const Extended& e, const Words& mixed, Surface& behind) {
    Words is_behind, encoded;
    for (std::size_t i = 0; i < mixed.size(); ++i) {
      is_behind.push_back(behind.inverse[i] >= 0);
      std::uint32_t word = mixed[i] || is_behind[i] ? 0 : DEFRAY_PATTERN_KNOWN;
      for (std::size_t c = 0; c < 3; ++c) {
        const float v = e.channels[std::min(c, e.channels.size() - 1)][i];
        word |= static_cast<std::uint32_t>(std::lround(255 * shown_value(v))) << (8 * c);
      }
      encoded.push_back(word);
    }
    const PatternFrame frame{e.width,      e.height,          encoded,
                             e.coc_quanta, behind.coc_quanta, is_behind};
    if (session_) {
      improve_by_patterns(*session_, frame, e.channels, {}, behind.channels);
    } else {
      reference::improve_by_patterns(frame, e.channels, {}, behind.channels);
    }
    done("patterns");
  }

  /// One fragment a pixel.
  Fragments whole_pixels(const Extended& e) {
    Fragments f{e.width, e.height, 1, e.coc_quanta, {}, {}, e.channels};
    f.depth = depth_of(e.inverse);
    f.data_of = e.data;
    for (std::size_t i = 0; i < f.depth.size(); ++i) f.coverage.push_back(flags(e, i));
    return f;
  }

  Fragments assembled(const Extended& e, const Surfaces& s) {
    Fragments f{e.width, e.height, 2, {}, {}, {}, {}};
    f.channels.resize(e.channels.size());
    const Plane depths[2] = {depth_of(s.front.inverse), depth_of(s.behind.inverse)};
    const Surface* const surfaces[2] = {&s.front, &s.behind};
    for (int y = 0; y < e.height; ++y) {
      for (int layer = 0; layer < 2; ++layer) {
        const Surface& from = *surfaces[layer];
        for (std::size_t i = size(y) * size(e.width); i < (size(y) + 1) * size(e.width); ++i) {
          const bool is_there = is_fragment(depths[layer][i]);
          f.coc_quanta.push_back(from.coc_quanta[i]);
          f.depth.push_back(depths[layer][i]);
          f.coverage.push_back(is_there ? from.coverage[i] | (flags(e, i) & DEFRAY_SYNTHESISED)
                                        : 0);
          for (std::size_t c = 0; c < f.channels.size(); ++c) {
            f.channels[c].push_back(from.channels[c][i]);
          }
          if (!e.data.empty()) f.data_of.push_back(data_of(e, from, layer, i));
          if (is_in_margin(e, i) || !is_there) continue;
          report_.behind += layer == 1 && from.coverage[i] >= DEFRAY_SYNTHESISED;
          report_.split += layer == 0 && from.coverage[i] < DEFRAY_WHOLE;
        }
      }
    }
    return f;
  }

  /// Whose data a fragment has. One on its pixel's own surface: the pixel's. One in front of it,
  /// which `split` found beside the pixel: that of the nearest pixel on its surface. What was made
  /// up: none.
  static std::uint32_t data_of(const Extended& e, const Surface& from, int layer, std::size_t i) {
    const auto is_on = [&](std::size_t pixel) {
      return e.inverse[pixel] == from.inverse[i] && e.coc_quanta[pixel] == from.coc_quanta[i];
    };
    if (layer == 1 && from.coverage[i] >= DEFRAY_SYNTHESISED) return DEFRAY_EMPTY;
    if (is_on(i)) return e.data[i];
    const int x = static_cast<int>(i % size(e.width)), y = static_cast<int>(i / size(e.width));
    constexpr int reach = 3;  // as far as `split` looks
    int least = 2 * reach * reach + 1;
    std::uint32_t data = DEFRAY_EMPTY;
    for (int j = std::max(0, y - reach); j <= std::min(e.height - 1, y + reach); ++j) {
      for (int k = std::max(0, x - reach); k <= std::min(e.width - 1, x + reach); ++k) {
        const std::size_t pixel = size(j) * size(e.width) + size(k);
        const int distance = (j - y) * (j - y) + (k - x) * (k - x);
        if (distance >= least || !is_on(pixel)) continue;
        least = distance;
        data = e.data[pixel];
      }
    }
    return data;
  }

  static Plane depth_of(const Plane& inverse) {
    Plane depth;
    depth.reserve(inverse.size());
    for (const float i : inverse) {
      depth.push_back(i < 0    ? no_fragment()
                      : i == 0 ? std::numeric_limits<float>::infinity()
                               : 1.0f / i);
    }
    return depth;
  }

  /// Coverage of a whole pixel; beyond the frame it was not seen.
  static std::uint32_t flags(const Extended& e, std::size_t i) {
    return is_in_margin(e, i) ? DEFRAY_WHOLE | DEFRAY_SYNTHESISED : DEFRAY_WHOLE;
  }

  LightSources take_highlights(Fragments& f, int light_channels) {
    LightSources lights;
    if (settings_.highlights) {
      const Plane kept = session_ ? defray::highlights(*session_, f, light_channels)
                                  : reference::highlights(f, light_channels);
      lights = take_light(f, kept, light_channels, make_aperture_table(mask_), rdb_.samples);
      report_.highlights = lights.where.size();
    }
    done("highlights");
    return lights;
  }

  std::vector<Plane> soften(const Fragments& f, int points) const {
    return session_ ? defray::soften(*session_, f, points) : reference::soften(f, points);
  }

  /// Where the frame lies: for what is random, and the lens's rim.
  void place(const Extended& e, const PinholeFrame& frame) {
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

  DefocusResult finish(const Extended& e, RdbResult result) {
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

}  // namespace

DefocusResult defocus(const PinholeFrame& frame, const DefocusSettings& settings,
                      const RdbSettings& rdb, Session* session,
                      const std::function<void(double)>& progress) {
  return Chain(settings, rdb, session).run(frame, progress);
}

}  // namespace defray
