// Kernels `patterns_*`: band after band and shift after shift.
#include <algorithm>
#include <array>
#include <list>

#include "base/parallel.h"
#include "chain/patterns_window.h"
#include "device/device_backend.h"
#include "frame/band_rows.h"

namespace defray {
namespace {

/// So many rows, a multiple of DEFRAY_PATTERN_STRIP, see all shifts before the next ones do: what
/// lies between the kernels stays in the cache. 64 to 256 rows take the same time, a frame 1.3 as
/// long.
constexpr int group_rows = 2 * DEFRAY_PATTERN_STRIP;

/// Rows of a band in which something is hidden.
struct PatternGroup {
  PatternGroup(Session& session, PatternUnits of_rows)
      : units(std::move(of_rows)),
        difference(session.view(units.difference)),
        columns(session.view(units.columns)),
        match(session.view(units.match)) {}
  PatternUnits units;
  cl::Buffer difference, columns, match;
};

/// A band on the device, and its launches for a group of rows and a shift.
class PatternBand {
 public:
  PatternBand(Session& session, const Frame& frame, const Words& pixels,
              const PatternMargins& margins, const PatternSettings& settings, int band_y,
              int band_rows)
      : session_(session),
        p_(patterns_band(frame, margins, settings, band_y, band_rows)),
        pixels_(patterns_window(frame, p_, band_y, pixels, 0u)),
        coc_(patterns_window(frame, p_, band_y, frame.coc_quanta, 0)),
        inverse_(patterns_window(frame, p_, band_y, frame.inverse, 0.0f)) {
    for (int y = 0; y < band_rows; y += group_rows) {
      PatternUnits units = patterns_units(p_, pixels_, y, std::min(y + group_rows, band_rows));
      if (!units.match.empty()) groups_.emplace_back(session, std::move(units));
    }
    if (groups_.empty()) return;
    pixel_buffer_ = session.view(pixels_);
    coc_buffer_ = session.view(coc_);
    inverse_buffer_ = session.view(inverse_);
    // Where no unit writes, nothing is known.
    difference_ = session.buffer(pixels_.size() * sizeof(std::uint32_t));
    columns_ = session.buffer(pixels_.size() * sizeof(std::uint64_t));
    session.clear(difference_, pixels_.size() * sizeof(std::uint32_t));
    session.clear(columns_, pixels_.size() * sizeof(std::uint64_t));
  }

  const std::list<PatternGroup>& groups() const { return groups_; }
  const DefrayPatternsParams& params() const { return p_; }

  void difference(const PatternGroup& group, PatternShift shift) {
    p_.shift_x = shift.x;
    p_.shift_y = shift.y;
    p_.parallel = shift.parallel;
    launch("patterns_difference", group.units.difference, group.difference, pixel_buffer_,
           coc_buffer_, inverse_buffer_, difference_);
  }

  void columns(const PatternGroup& group) {
    launch("patterns_columns", group.units.columns, group.columns, difference_, columns_);
  }

  template <typename... Buffers>
  void match(const PatternGroup& group, bool is_first, const Buffers&... buffers) {
    p_.is_first = is_first;
    launch("patterns_match", group.units.match, group.match, pixel_buffer_, coc_buffer_, columns_,
           buffers...);
  }

  std::vector<std::uint32_t> read_difference() const { return read<std::uint32_t>(difference_); }
  std::vector<std::uint64_t> read_columns() const { return read<std::uint64_t>(columns_); }

 private:
  template <typename... Buffers>
  void launch(const char* name, const std::vector<PatternUnit>& units, const Buffers&... buffers) {
    p_.unit_count = static_cast<std::uint32_t>(units.size());
    session_.launch(name, {units.size()}, p_, buffers...);
  }

  /// The band's pixels of a window.
  template <typename T>
  std::vector<T> read(const cl::Buffer& buffer) const {
    std::vector<T> band;
    session_.look_at<T>(buffer, pixels_.size(), [&](std::span<const T> window) {
      for (std::size_t y = 0; y < p_.rows; ++y) {
        const auto row = window.subspan((y + p_.margin_y) * p_.stride + p_.margin_x, p_.width);
        band.insert(band.end(), row.begin(), row.end());
      }
    });
    return band;
  }

  Session& session_;
  DefrayPatternsParams p_;
  std::vector<std::uint32_t> pixels_;
  std::vector<std::int32_t> coc_;
  Plane inverse_;
  std::list<PatternGroup> groups_;
  cl::Buffer pixel_buffer_, coc_buffer_, inverse_buffer_, difference_, columns_;
};

/// Four channels from `count` pixels on; a missing one repeats the last.
std::array<cl::Buffer, 4> four_channels(Session& session, const Planes& planes, std::size_t first,
                                        std::size_t count) {
  std::array<cl::Buffer, 4> buffers;
  for (std::size_t c = 0; c < 4; ++c) {
    buffers[c] =
        c < planes.size() ? session.view(&planes[c][first], count * sizeof(float)) : buffers[c - 1];
  }
  return buffers;
}

void match_band(Session& session, const Frame& frame, const Frame& behind, const Words& pixels,
                PatternBand& band, int band_y, const std::vector<PatternShift>& shifts,
                PatternSums& out) {
  if (band.groups().empty()) return;
  const DefrayPatternsParams& p = band.params();
  const std::size_t first = size(band_y) * p.width, count = std::size_t{p.rows} * p.width;
  const int source_y = band_y - static_cast<int>(p.source_row);
  const int source_end = std::min(band_y + static_cast<int>(p.rows + p.margin_y), frame.height);
  const auto smooth = four_channels(session, behind.channels, first, count);
  const auto source = four_channels(session, frame.channels, size(source_y) * p.width,
                                    size(source_end - source_y) * p.width);
  const cl::Buffer behind_coc =
      session.view(&behind.coc_quanta[first], count * sizeof(std::int32_t));
  const cl::Buffer behind_inverse = session.view(&behind.inverse[first], count * sizeof(float));
  const std::size_t planes = 4 + 2;  // channels, weight and weighted square
  const cl::Buffer buffer = session.buffer(planes * count * sizeof(float));
  for (const PatternGroup& group : band.groups()) {
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      band.difference(group, shifts[i]);
      band.columns(group);
      band.match(group, i == 0, behind_coc, behind_inverse, smooth, source, buffer);
    }
  }
  const auto words = pixels.host().subspan(first, count);
  const auto is_behind = [&](std::size_t i) { return (words[i] & DEFRAY_PATTERN_BEHIND) != 0; };
  session.look_at<float>(buffer, planes * count, [&](std::span<const float> sums) {
    parallel_for_each(count, [&](std::size_t i) {
      if (!is_behind(i)) return;
      for (std::size_t c = 0; c < out.difference.size(); ++c) {
        out.difference[c][first + i] = sums[c * count + i];
      }
      out.weight[first + i] = sums[4 * count + i];
      out.weighted_square[first + i] = sums[5 * count + i];
    });
  });
}

/// Bands whose planes fit the memory.
std::vector<BandRows> bands_of(const Frame& frame, const PatternMargins& margins,
                               std::size_t memory_bytes) {
  const std::size_t none = patterns_band_bytes(frame.width, margins, 0);
  const std::size_t row = patterns_band_bytes(frame.width, margins, 1) - none;
  return cut_into_bands(frame.height, rows_that_fit(frame.height, memory_bytes, none, row), 0);
}

PatternBand whole_frame(Session& session, const Frame& frame, const Words& pixels,
                        PatternShift shift, const PatternSettings& settings) {
  return {session,  frame, pixels,      PatternMargins({shift}, settings.window_px),
          settings, 0,     frame.height};
}

}  // namespace

std::vector<std::uint32_t> DeviceBackend::patterns_difference(const Frame& frame,
                                                              const Words& pixels,
                                                              PatternShift shift,
                                                              const PatternSettings& settings) {
  PatternBand band = whole_frame(session_, frame, pixels, shift, settings);
  if (band.groups().empty()) return std::vector<std::uint32_t>(pixels.size());
  for (const PatternGroup& group : band.groups()) band.difference(group, shift);
  return band.read_difference();
}

std::vector<std::uint64_t> DeviceBackend::patterns_columns(const Frame& frame, const Words& pixels,
                                                           PatternShift shift,
                                                           const PatternSettings& settings) {
  PatternBand band = whole_frame(session_, frame, pixels, shift, settings);
  if (band.groups().empty()) return std::vector<std::uint64_t>(pixels.size());
  for (const PatternGroup& group : band.groups()) {
    band.difference(group, shift);
    band.columns(group);
  }
  return band.read_columns();
}

PatternSums DeviceBackend::patterns(const Frame& frame, const Frame& behind, const Words& pixels,
                                    const std::vector<PatternShift>& shifts,
                                    const PatternSettings& settings) {
  PatternSums out(frame.channels.size(), pixels.size());
  if (shifts.empty()) return out;
  const PatternMargins margins(shifts, settings.window_px);
  for (const BandRows& rows : bands_of(frame, margins, session_.memory_bytes())) {
    PatternBand band(session_, frame, pixels, margins, settings, rows.y, rows.rows);
    match_band(session_, frame, behind, pixels, band, rows.y, shifts, out);
  }
  return out;
}

}  // namespace defray
