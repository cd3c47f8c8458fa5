// defray validate --arithmetic, and the files that both kinds of validation write.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "defray/defray.h"
#include "image/safe_output.h"
#include "opencl/device.h"
#include "progress.h"
#include "validate/validate.h"
#include "validation/arithmetic.h"

namespace defray::cli {

using namespace defray::validation;

std::string version_and_date() {
  const std::time_t now = std::time(nullptr);
  return fmt::format("defray {}, {:%Y-%m-%d}", version(), fmt::gmtime(now));
}

void write_reports(const ValidateOptions& o, const Page& page, const TemporaryFolder& pictures,
                   const std::string& json) {
  write_single_file(o.folder + "/report.html", page, pictures.path());
  write_text(o.folder + "/report.json", json);
  if (o.json) {
    fmt::print("{}", json);
  } else if (!o.quiet) {
    fmt::print("{}/report.html\n{}/report.json\n", o.folder, o.folder);
  }
}

int run_arithmetic(const ValidateOptions& o) {
  const DeviceInfo info = select_device(o.device);
  const auto results = [&] {
    ProgressBar bar(1, "arithmetic", !o.quiet);
    const int width = o.full ? 1280 : 640;
    return measure_arithmetic(info, width, width * 3 / 4, o.full ? 21 : 9, Level::quick,
                              [&](double share) { bar.update(0, share); });
  }();
  if (o.has_text()) {
    for (const VariantResult& r : results) {
      for (const MethodFigures& m : r.methods) {
        fmt::print(
            "{:18} {:24} x {:.2f} of strict's time, {:6.1f} dB, {:6.2f} % of values changed{}\n",
            r.name, m.method, m.time_ratio, m.psnr_db, 100 * m.changed,
            m.is_stable ? "" : ", differs with the work-group");
      }
    }
  }
  const TemporaryFolder pictures("defray-report");
  const Page page{"defray: arithmetic on " + info.name,
                  fmt::format("{}, {}; {}", info.platform, info.version, version_and_date()),
                  {to_section(results, pictures.path())}};
  write_reports(o, page, pictures, to_json(results));
  return 0;
}

}  // namespace defray::cli
