// What `defray validate` finds here: kernels against twins on every device, and relaxed arithmetic.
#include <cmath>

#include "base/text.h"
#include "tables/tables.h"
#include "validation/arithmetic.h"

namespace defray::perf {
namespace {

using namespace defray::validation;

Level level_of(const Bench& bench) { return bench.is_quick ? Level::tiny : Level::quick; }

/// Columns of a build: each method's time and likeness, and the kernels that changed with it.
std::vector<std::string> row_of(const VariantResult& r, const VariantResult& strict) {
  std::vector<std::string> row{r.name};
  for (const MethodFigures& m : r.methods) {
    row.push_back(
        fmt::format("× {:.2f}, {}", m.time_ratio,
                    std::isinf(m.psnr_db) ? "equal" : fmt::format("{:.0f} dB", m.psnr_db)));
  }
  std::vector<std::string> changed;
  for (std::size_t k = 0; k < r.kernels.kernels.size(); ++k) {
    const KernelResult& kernel = r.kernels.kernels[k];
    if (kernel.verdict.differing > strict.kernels.kernels[k].verdict.differing) {
      changed.push_back("`" + kernel.kernel + "`");
    }
  }
  row.push_back(changed.empty() ? "none" : join(changed, ", "));
  return row;
}

double largest_spread(const std::vector<VariantResult>& results) {
  double largest = 0;
  for (const VariantResult& r : results) {
    for (const MethodFigures& m : r.methods) largest = std::fmax(largest, m.time_spread);
  }
  return largest;
}

/// "all 23 pass, 2072 cases".
std::string result_of(const DeviceResult& d) {
  std::size_t cases = 0;
  std::vector<std::string> failed;
  for (const KernelResult& k : d.kernels) {
    cases += k.cases;
    if (!k.passed()) failed.push_back("`" + k.kernel + "`");
  }
  return failed.empty() ? fmt::format("all {} pass, {} cases", d.kernels.size(), cases)
                        : fmt::format("{} of {} FAIL: {}", failed.size(), d.kernels.size(),
                                      join(failed, ", "));
}

/// "3.1+debian" of "OpenCL 3.0 PoCL, driver 3.1+debian".
std::string driver_of(const std::string& version) {
  const std::string word = "driver ";
  const std::size_t at = version.find(word);
  return at == std::string::npos ? version : version.substr(at + word.size());
}

/// Kernels whose results' hash is that of the first device.
std::size_t count_equal(const DeviceResult& d, const DeviceResult& first) {
  std::size_t equal = 0;
  for (std::size_t k = 0; k < d.kernels.size(); ++k) {
    equal += d.kernels[k].hash == first.kernels[k].hash;
  }
  return equal;
}

}  // namespace

Figures measure_arithmetic(TableBench& b) {
  const Bench& bench = b.bench();
  const auto results = validation::measure_arithmetic(
      bench.backend.session().info(), bench.size(640), bench.size(480), bench.is_quick ? 1 : 9,
      level_of(bench),
      [&](double share) { bench.step(fmt::format("arithmetic: {:.0f} %", 100 * share)); });
  Figures figures{{"", "", {"build"}, {}}, {}};
  for (const MethodFigures& m : results[0].methods) figures.table.columns.push_back(m.method);
  figures.table.columns.push_back("kernels with other bits");
  for (const VariantResult& r : results) {
    if (r.error.empty()) {
      figures.table.rows.push_back(row_of(r, results[0]));
    } else {
      figures.notes.push_back(fmt::format("Not on this device: {} ({}).", r.name, r.error));
    }
  }
  figures.notes.push_back(fmt::format("Ratios spread by up to {:.0f} % (largest − smallest).",
                                      100 * largest_spread(results)));
  return figures;
}

Figures measure_validation(TableBench& b) {
  const Bench& bench = b.bench();
  Settings settings;
  settings.level = level_of(bench);
  std::vector<DeviceResult> results;
  Figures figures{{"", "", {"device", "result", "the same bits as the first", "time"}, {}}, {}};
  for (const DeviceInfo& info : list_devices()) {
    bench.step("validate: " + info.name);
    const double seconds = seconds_of([&] { results.push_back(validate_device(info, settings)); });
    const DeviceResult& d = results.back();
    figures.table.rows.push_back(
        {fmt::format("{} {}: {}", d.platform, driver_of(d.version), d.device), result_of(d),
         fmt::format("{} of {} checks", count_equal(d, results[0]), d.kernels.size()),
         fmt::format("{:.0f} s", seconds)});
  }
  return figures;
}

}  // namespace defray::perf
