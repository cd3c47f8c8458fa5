#include "trade/trade_truth.h"

#include <cmath>
#include <cstddef>

#include "base/error.h"
#include "base/text.h"
#include "measure/metrics.h"

namespace defray::cli {

ColourFile read_truth(const std::string& path, const ChannelRequest& request) {
  try {
    return read_colour_file(path);
  } catch (const Error&) {
    if (request.layer.empty() && request.view.empty()) throw;
  }
  return read_colour_file(path, {request.layer, request.view, {}});
}

double true_db_of(ColourFile truth, const FrameResult& result) {
  ColourFile own{result.report.paths.output, result.colour, result.report.data,
                 result.report.display};
  own.planes.resize(3);
  truth.planes.resize(3);
  bring_together({&own, &truth}, {true, {}});
  return compare(own.planes, truth.planes, own.data.width).psnr_srgb_db;
}

void check_truth(const std::string& path, const ColourFile& truth, const std::string& input_path,
                 const FrameReport& input) {
  if (truth.display != input.display) {
    fail(ErrorKind::input, "{} has display window {}, {} has {}: both must be the same", path,
         to_string(truth.display), input_path, to_string(input.display));
  }
  if (truth.is_grey && input.colour_channels.size() > 2) {
    fail(ErrorKind::input, "{}: is grey, {} has {}: no truth of it", path, input_path,
         join(input.colour_channels, " "));
  }
  for (const Plane& plane : truth.planes) {
    for (std::size_t i = 0; i < plane.size(); ++i) {
      if (std::isfinite(plane[i])) continue;
      const std::size_t width = static_cast<std::size_t>(truth.data.width);
      fail(ErrorKind::input, "{}: has {} at pixel ({}, {}): a truth has none of it", path, plane[i],
           i % width, i / width);
    }
  }
}

}  // namespace defray::cli
