#include "validation/arithmetic.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/stopwatch.h"
#include "device/device_backend.h"
#include "scenes/subject.h"

namespace defray::validation {
namespace {

constexpr const char* no_pragma = "-DDEFRAY_FAST_MATH";  // lets the compiler contract a * b + c

SessionOptions with(const std::string& build_options) {
  SessionOptions options;
  options.build_options = build_options;
  options.measures = true;
  return options;
}

SessionOptions fast() {
  SessionOptions options = with("");
  options.math = Math::fast;
  return options;
}

struct NamedMethod {
  std::string name;
  MethodSettings settings;
};

std::vector<NamedMethod> methods() {
  MethodSettings rdb, linear, literal, aware;
  linear.method = Method::linear;
  literal.method = aware.method = Method::gather;
  literal.gather.kind = GatherKind::literal;
  return {{"rdb, 9x9", rdb},
          {"linear", linear},
          {"gather literal, 32 x 2", literal},
          {"gather aware, 32 x 2", aware}};
}

double share_changed(const std::vector<Plane>& a, const std::vector<Plane>& b) {
  double changed = 0, all = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    for (std::size_t i = 0; i < a[c].size(); ++i) {
      changed += ulp_distance(a[c][i], b[c][i]) != 0;
      ++all;
    }
  }
  return changed / all;
}

bool is_stable(Session& session, const Subject& subject, const MethodSettings& settings,
               const std::vector<Plane>& expected) {
  bool same = true;
  for (const auto& [x, y] : {std::pair<std::size_t, std::size_t>{7, 3}, {0, 0}}) {
    session.set_work_group(x, y);
    DeviceBackend backend(session);
    same = same && render(backend, subject, settings) == expected;
  }
  return same;
}

/// Median, and largest minus smallest.
struct Spread {
  double median = 1, width = 0;
};
Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.back() - values.front()};
}

/// One variant at work.
struct Trial {
  const Variant* variant;
  std::unique_ptr<Session> session;
  std::vector<std::vector<double>> method_seconds;  ///< [method][round]
  std::map<std::string, std::vector<double>> kernel_seconds;
};

/// Each method in all variants, one right after the other: a busy machine is busy for all of them.
void time_round(std::vector<Trial>& trials, const Subject& subject,
                const std::vector<NamedMethod>& all) {
  for (Trial& trial : trials) {
    if (trial.session) trial.session->take_kernel_seconds();  // of what was run before
  }
  for (std::size_t m = 0; m < all.size(); ++m) {
    for (Trial& trial : trials) {
      if (!trial.session) continue;
      trial.method_seconds.resize(all.size());
      DeviceBackend backend(*trial.session);
      const Stopwatch watch;
      render(backend, subject, all[m].settings);
      trial.method_seconds[m].push_back(watch.seconds());
    }
  }
  for (Trial& trial : trials) {
    if (!trial.session) continue;
    for (const auto& [kernel, seconds] : trial.session->take_kernel_seconds()) {
      trial.kernel_seconds[kernel].push_back(seconds);
    }
  }
}

Spread ratio(const std::vector<double>& times, const std::vector<double>& strict) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.size(); ++i) ratios.push_back(times[i] / strict[i]);
  return spread_of(ratios);
}

MethodFigures figures_of(Trial& trial, const Subject& subject, const NamedMethod& method,
                         const std::vector<Plane>& strict) {
  MethodFigures f;
  f.method = method.name;
  DeviceBackend backend(*trial.session);
  const auto picture = render(backend, subject, method.settings);
  const Comparison c = defray::compare(picture, strict, subject.scene.width);
  f.psnr_db = c.psnr_srgb_db;
  f.worst = c.worst;
  f.changed = share_changed(picture, strict);
  f.is_stable = is_stable(*trial.session, subject, method.settings, picture);
  return f;
}

VariantResult open_trial(const DeviceInfo& info, const Variant& variant, Level level,
                         Trial& trial) {
  VariantResult result;
  result.name = variant.name;
  result.about = variant.about;
  trial.variant = &variant;
  try {
    trial.session = std::make_unique<Session>(info, variant.options);
    Settings settings;
    settings.session = variant.options;
    settings.level = level;
    // Work-groups change no rule, and each size is another program to compile: that of pictures.
    settings.group_x = 0;
    result.kernels = validate_device(info, settings);
  } catch (const Error& error) {
    result.error = error.what();
  }
  return result;
}

}  // namespace

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"strict", "as written: contraction off, divisions and roots correctly rounded", with("")},
      {"mad", "-cl-mad-enable: a * b + c in one, contraction on",
       with(std::string("-cl-mad-enable ") + no_pragma)},
      {"fast", "-cl-fast-relaxed-math, contraction on (math fast)", fast()},
      {"denormals flushed", "-cl-denorms-are-zero", with("-cl-denorms-are-zero")}};
  return all;
}

std::vector<VariantResult> measure_arithmetic(const DeviceInfo& info, int width, int height,
                                              int rounds, Level level,
                                              const std::function<void(double)>& progress) {
  std::vector<VariantResult> results;
  std::vector<Trial> trials(variants().size());
  const double steps = static_cast<double>(2 * trials.size()) + rounds;
  double done = 0;
  const auto step = [&] {
    if (progress) progress(++done / steps);
  };
  for (std::size_t i = 0; i < trials.size(); ++i, step()) {
    results.push_back(open_trial(info, variants()[i], level, trials[i]));
  }
  if (!trials[0].session) fail(ErrorKind::device, "{}", results[0].error);
  DeviceBackend backend(*trials[0].session);
  const Subject subject = make_subject(backend, make_scene("fence", width, height), "bg");
  const std::vector<NamedMethod> all = methods();
  std::vector<std::vector<Plane>> strict;
  for (const NamedMethod& m : all) strict.push_back(render(backend, subject, m.settings));
  for (std::size_t i = 0; i < trials.size(); ++i, step()) {
    if (!trials[i].session) continue;
    for (std::size_t m = 0; m < all.size(); ++m) {
      results[i].methods.push_back(figures_of(trials[i], subject, all[m], strict[m]));
    }
  }
  for (int round = 0; round < rounds; ++round, step()) {
    time_round(trials, subject, all);
  }
  for (std::size_t i = 0; i < trials.size(); ++i) {
    for (std::size_t m = 0; m < results[i].methods.size(); ++m) {
      const Spread s = ratio(trials[i].method_seconds[m], trials[0].method_seconds[m]);
      results[i].methods[m].time_ratio = s.median;
      results[i].methods[m].time_spread = s.width;
    }
    for (const auto& [kernel, seconds] : trials[i].kernel_seconds) {
      results[i].kernel_time_ratio[kernel] =
          ratio(seconds, trials[0].kernel_seconds[kernel]).median;
    }
  }
  return results;
}

}  // namespace defray::validation
