// Kernel `tiltshift`.
#include <algorithm>

#include "device/device_backend.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow tiltshift_launch({.kernel = "tiltshift", .group = {64, 1}});

/// Of a plane that no buffer holds, some rows after the others.
Quanta tiltshift_in_parts(Session& session, const DefrayTiltshiftParams& all, std::size_t most) {
  std::vector<std::int32_t> coc(std::size_t{all.width} * all.rows);
  const auto rows = static_cast<std::uint32_t>(std::max<std::size_t>(most / all.width, 1));
  for (std::uint32_t first = 0; first < all.rows; first += rows) {
    DefrayTiltshiftParams p = all;
    p.rows = std::min(rows, all.rows - first);
    p.first_row_px = all.first_row_px + static_cast<float>(first);
    std::int32_t* const place = &coc[std::size_t{first} * p.width];
    const std::size_t count = std::size_t{p.width} * p.rows;
    const cl::Buffer out = session.write_view(place, count * sizeof(std::int32_t));
    session.launch("tiltshift", {p.width, p.rows}, p, out);
    session.bring(out, count, place);
  }
  return coc;
}

}  // namespace

Quanta DeviceBackend::tiltshift(const DefrayTiltshiftParams& p) {
  const std::size_t count = std::size_t{p.width} * p.rows;
  const std::size_t most = session_.info().max_buffer_bytes / sizeof(std::int32_t);
  if (count > most) return tiltshift_in_parts(session_, p, most);
  Quanta coc;
  const cl::Buffer out = session_.out(coc, count);
  session_.launch("tiltshift", {p.width, p.rows}, p, out);
  return coc;
}

}  // namespace defray
