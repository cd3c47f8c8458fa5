// Kernels `patterns_*`: band after band and shift after shift.
#include <algorithm>
#include <array>

#include "chain/pattern_window.h"
#include "device/device_stages.h"

namespace defray {
namespace {

/// A band on the device, and its launches for one shift after the other.
class PatternBand {
 public:
  PatternBand(Session& session, const Frame& frame, const Words& pixels,
              const PatternMargins& margins, const PatternSettings& settings, int band_y,
              int band_rows)
      : session_(session),
        p_(pattern_band(frame, margins, settings, band_y, band_rows)),
        pixels_(pattern_window(frame, p_, band_y, pixels, 0u)),
        coc_(pattern_window(frame, p_, band_y, frame.coc_quanta, 0)),
        inverse_(pattern_window(frame, p_, band_y, frame.inverse, 0.0f)),
        units_(pattern_units(p_, pixels_)),
        zeros_(pixels_.size()) {
    if (!anything()) return;
    pixel_buffer_ = session.view(pixels_);
    coc_buffer_ = session.view(coc_);
    inverse_buffer_ = session.view(inverse_);
    difference_units_ = session.view(units_.difference);
    column_units_ = session.view(units_.columns);
    match_units_ = session.view(units_.match);
    // Where no unit writes, nothing is known.
    difference_ = session.buffer(zeros_.size() * sizeof(std::uint32_t));
    sums_ = session.buffer(zeros_.size() * sizeof(std::uint64_t));
    session.write(difference_, zeros_.data(), zeros_.size() * sizeof(std::uint32_t));
    session.write(sums_, zeros_.data(), zeros_.size() * sizeof(std::uint64_t));
  }

  bool anything() const { return !units_.match.empty(); }
  const DefrayPatternParams& params() const { return p_; }

  void difference(PatternShift shift) {
    p_.shift_x = shift.x;
    p_.shift_y = shift.y;
    p_.parallel = shift.parallel;
    launch("patterns_difference", units_.difference, difference_units_, pixel_buffer_, coc_buffer_,
           inverse_buffer_, difference_);
  }

  void columns() { launch("patterns_columns", units_.columns, column_units_, difference_, sums_); }

  template <typename... Buffers>
  void match(bool is_first, const Buffers&... buffers) {
    p_.is_first = is_first;
    launch("patterns_match", units_.match, match_units_, pixel_buffer_, coc_buffer_, sums_,
           buffers...);
  }

  std::vector<std::uint32_t> read_difference() const { return read<std::uint32_t>(difference_); }
  std::vector<std::uint64_t> read_sums() const { return read<std::uint64_t>(sums_); }

 private:
  template <typename... Buffers>
  void launch(const char* name, const std::vector<PatternUnit>& units, const Buffers&... buffers) {
    p_.unit_count = static_cast<std::uint32_t>(units.size());
    session_.launch(name, {units.size()}, p_, buffers...);
  }

  /// The band's pixels of a window.
  template <typename T>
  std::vector<T> read(const cl::Buffer& buffer) const {
    std::vector<T> window(zeros_.size()), band;
    session_.read(buffer, window.data(), window.size() * sizeof(T));
    for (std::size_t y = 0; y < p_.rows; ++y) {
      const auto from =
          window.begin() + static_cast<std::int64_t>((y + p_.margin_y) * p_.stride + p_.margin_x);
      band.insert(band.end(), from, from + p_.width);
    }
    return band;
  }

  Session& session_;
  DefrayPatternParams p_;
  std::vector<std::uint32_t> pixels_;
  std::vector<std::int32_t> coc_;
  Plane inverse_;
  PatternUnits units_;
  std::vector<std::uint64_t> zeros_;
  cl::Buffer pixel_buffer_, coc_buffer_, inverse_buffer_, difference_units_, column_units_,
      match_units_, difference_, sums_;
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
  if (!band.anything()) return;
  const DefrayPatternParams& p = band.params();
  const std::size_t first = size(band_y) * p.width, count = std::size_t{p.rows} * p.width;
  const int source_y = band_y - static_cast<int>(p.source_row);
  const int source_end = std::min(band_y + static_cast<int>(p.rows + p.margin_y), frame.height);
  const auto smooth = four_channels(session, behind.channels, first, count);
  const auto source = four_channels(session, frame.channels, size(source_y) * p.width,
                                    size(source_end - source_y) * p.width);
  const cl::Buffer behind_coc =
      session.view(&behind.coc_quanta[first], count * sizeof(std::int32_t));
  const cl::Buffer behind_inverse = session.view(&behind.inverse[first], count * sizeof(float));
  const cl::Buffer sum = session.buffer(count * sizeof(cl_float4));
  const cl::Buffer weight = session.buffer(count * sizeof(cl_float2));
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    band.difference(shifts[i]);
    band.columns();
    band.match(i == 0, behind_coc, behind_inverse, smooth, source, sum, weight);
  }
  std::vector<cl_float4> sums(count);
  std::vector<cl_float2> weights(count);
  session.read(sum, sums.data(), count * sizeof(cl_float4));
  session.read(weight, weights.data(), count * sizeof(cl_float2));
  for (std::size_t i = 0; i < count; ++i) {
    if (!(pixels[first + i] & DEFRAY_PATTERN_BEHIND)) continue;
    for (std::size_t c = 0; c < out.difference.size(); ++c)
      out.difference[c][first + i] = sums[i].s[c];
    out.weight[first + i] = weights[i].s[0];
    out.weighted_square[first + i] = weights[i].s[1];
  }
}

/// Rows of a band whose planes fit the memory; at least one, whatever it takes.
int band_rows_for(const Frame& frame, const PatternMargins& margins, std::size_t memory_bytes) {
  const std::size_t none = pattern_band_bytes(frame.width, margins, 0);
  const std::size_t row = pattern_band_bytes(frame.width, margins, 1) - none;
  const std::size_t left = memory_bytes - std::min(none, memory_bytes);
  return static_cast<int>(std::clamp<std::size_t>(left / row, 1, size(frame.height)));
}

PatternBand whole_frame(Session& session, const Frame& frame, const Words& pixels,
                        PatternShift shift, const PatternSettings& settings) {
  return {session,  frame, pixels,      PatternMargins({shift}, settings.window_px),
          settings, 0,     frame.height};
}

}  // namespace

std::vector<std::uint32_t> DeviceStages::pattern_difference(const Frame& frame, const Words& pixels,
                                                            PatternShift shift,
                                                            const PatternSettings& settings) {
  PatternBand band = whole_frame(session_, frame, pixels, shift, settings);
  if (!band.anything()) return std::vector<std::uint32_t>(pixels.size());
  band.difference(shift);
  return band.read_difference();
}

std::vector<std::uint64_t> DeviceStages::pattern_columns(const Frame& frame, const Words& pixels,
                                                         PatternShift shift,
                                                         const PatternSettings& settings) {
  PatternBand band = whole_frame(session_, frame, pixels, shift, settings);
  if (!band.anything()) return std::vector<std::uint64_t>(pixels.size());
  band.difference(shift);
  band.columns();
  return band.read_sums();
}

PatternSums DeviceStages::patterns(const Frame& frame, const Frame& behind, const Words& pixels,
                                   const std::vector<PatternShift>& shifts,
                                   const PatternSettings& settings) {
  PatternSums out(frame.channels.size(), pixels.size());
  if (shifts.empty()) return out;
  const PatternMargins margins(shifts, settings.window_px);
  const int most = band_rows_for(frame, margins, session_.memory_bytes());
  for (int y = 0; y < frame.height; y += most) {
    const int rows = std::min(most, frame.height - y);
    PatternBand band(session_, frame, pixels, margins, settings, y, rows);
    match_band(session_, frame, behind, pixels, band, y, shifts, out);
  }
  return out;
}

}  // namespace defray
