// Kernel `linear_psf`: band after band, their source planes with what is in reach around them.
#include "methods/linear.h"

#include <algorithm>
#include <array>

#include "device/device_backend.h"
#include "methods/linear_band.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow linear_psf_launch({"linear_psf", WorkGroup{16, 1}});

/// Rows of a launch: few enough that a progress bar moves.
constexpr std::uint32_t linear_rows_per_launch = 16;

void blur_band(Session& session, DefrayLinearParams p, const PaddedBand& band, int band_rows,
               const Plane& radius, const std::vector<Plane>& scaled, std::vector<Plane>& out,
               const std::function<void(int rows)>& progress) {
  const auto rows = static_cast<std::uint32_t>(band_rows);
  const std::size_t bytes = std::size_t{p.target_stride} * rows * sizeof(float);
  const std::vector<std::int32_t> reaches = row_reaches(radius, band);
  const cl::Buffer reach = session.view(reaches), r = session.view(radius);
  std::array<cl::Buffer, 4> in, result;
  // The kernel always sums four channels; a missing one repeats the last and is not read back.
  for (std::size_t c = 0; c < 4; ++c) {
    in[c] = c < scaled.size() ? session.view(scaled[c]) : in[c - 1];
    result[c] = session.buffer(bytes);
  }
  for (p.first_row = 0; p.first_row < rows; p.first_row += linear_rows_per_launch) {
    p.launch_rows = std::min(linear_rows_per_launch, rows - p.first_row);
    session.launch("linear_psf", {p.target_stride / DEFRAY_LINEAR_RUN, p.launch_rows}, p, reach, r,
                   in, result);
    session.finish();
    progress(static_cast<int>(p.first_row + p.launch_rows));
  }
  for (std::size_t c = 0; c < out.size(); ++c) {
    out[c].resize(bytes / sizeof(float));
    session.read(result[c], out[c].data(), bytes);
  }
}

}  // namespace

std::vector<Plane> DeviceBackend::linear(const Frame& f, const Progress& progress) {
  const int width = f.width, height = f.height;
  const auto coc_quanta = f.coc_quanta.host();
  const int reach = linear_reach(coc_quanta);
  const DiscNorms norm(reach + 1);
  std::vector<Plane> out(f.channels.size(), Plane(coc_quanta.size())), band_out(f.channels.size());
  for (const BandRows& rows : linear_bands(width, height, reach, session_.memory_bytes())) {
    const PaddedBand band(width, height, rows, reach);
    const Plane radius = band.plane([&](std::size_t i) { return radius_px(coc_quanta[i]); });
    std::vector<Plane> scaled;
    for (const Values<float>& channel : f.channels) {
      scaled.push_back(band.plane([&, values = channel.host()](std::size_t i) {
        const double twice = 2 * norm(static_cast<double>(radius_px(coc_quanta[i])));
        return values[i] / static_cast<float>(twice);
      }));
    }
    DefrayLinearParams p{};
    p.width = static_cast<std::uint32_t>(width);
    p.source_stride = static_cast<std::uint32_t>(band.stride);
    p.target_stride = static_cast<std::uint32_t>(PaddedBand::target_stride_for(width));
    p.reach = reach;
    blur_band(session_, p, band, rows.rows, radius, scaled, band_out, [&](int done) {
      if (progress) progress(static_cast<double>(rows.y + done) / height);
    });
    for (std::size_t c = 0; c < out.size(); ++c) {
      for (int row = 0; row < rows.rows; ++row) {
        std::copy_n(band_out[c].begin() + std::int64_t{row} * p.target_stride, width,
                    out[c].begin() + std::int64_t{rows.y + row} * width);
      }
    }
  }
  return out;
}

}  // namespace defray
