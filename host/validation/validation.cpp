#include "validation/validation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "device/device_backend.h"
#include "validation/case_queue.h"
#include "validation/oclgrind_log.h"
#include "validation/worst_picture.h"

namespace defray::validation {
namespace {

/// The shape of a result must be right before its values can be.
void require_same_shape(const Outcome& kernel, const Outcome& twin) {
  bool same =
      kernel.integers.size() == twin.integers.size() && kernel.planes.size() == twin.planes.size();
  for (std::size_t p = 0; same && p < twin.planes.size(); ++p) {
    same = kernel.planes[p].size() == twin.planes[p].size();
  }
  if (!same) fail(ErrorKind::internal, "kernel and twin give different numbers of values");
}

class CheckRun {
 public:
  CheckRun(Session& session, const KernelCheck& check, DeviceResult& device)
      : session_(session), check_(check), device_(device) {
    result_.kernel = check.name;
    result_.rule = check.rule;
    result_.hash = 0xcbf29ce484222325u;
  }

  void run(const PreparedCase& prepared) {
    const Case& c = prepared.values;
    const std::string text = to_string(c);
    session_.fill_buffers(0x00);
    const Outcome kernel = run_kernel(session_, check_, c, prepared.input);
    require_same_shape(kernel, prepared.twin);
    const DeviceInfo& info = session_.info();
    Verdict verdict = compare(check_, c, prepared.input, kernel, prepared.twin,
                              info.keeps_denormals, info.rounds_divisions);
    if (prepared.exact) measure_rounding(prepared, kernel, verdict);
    ++result_.cases;
    const std::uint64_t hash = hash_of(kernel);
    session_.fill_buffers(0xa5);  // other bits where a kernel reads what nobody wrote
    if (hash_of(run_kernel(session_, check_, c, prepared.input)) != hash) ++result_.unstable;
    result_.hash = (result_.hash ^ hash) * 0x100000001b3u;
    if (verdict.wrong > 0 && result_.first_wrong.empty()) result_.first_wrong = text;
    if (result_.verdict.add(verdict)) result_.worst_case = text;
  }

  bool has_failed() const { return !result_.passed(); }

  void stop_at(const Case& c, const Error& error) {
    result_.error = to_string(c) + ": " + error.what();
  }

  KernelResult finish(double seconds) {
    result_.seconds = seconds;
    return result_;
  }

 private:
  void measure_rounding(const PreparedCase& prepared, const Outcome& kernel, Verdict& verdict) {
    compare_exact(*prepared.exact, prepared.input, kernel, verdict);
    device_.exact.push_back({check_.name, prepared.exact->roundings, verdict.exact_share});
  }

  Session& session_;
  const KernelCheck& check_;
  DeviceResult& device_;
  KernelResult result_;
};

std::vector<const KernelCheck*> chosen_checks(const Settings& settings) {
  std::vector<const KernelCheck*> chosen;
  for (const std::string& name : settings.kernels) {
    const KernelCheck* check = &find_check(name);
    if (std::find(chosen.begin(), chosen.end(), check) == chosen.end()) chosen.push_back(check);
  }
  if (!chosen.empty()) return chosen;
  for (const KernelCheck& check : kernel_checks()) {
    // One case for all kernels: some take no such CoC.
    const bool takes_it =
        settings.only_case.empty() || std::isfinite(check.work(parse_case(settings.only_case)));
    if (takes_it) chosen.push_back(&check);
  }
  return chosen;
}

/// Shows a kernel's largest difference, where there is one.
void add_picture(Session& session, const KernelCheck& check, const KernelResult& result,
                 DeviceResult& device) {
  if (result.worst_case.empty()) return;
  const Case c = parse_case(result.worst_case);
  const auto picture = worst_picture(c, run_case(session, check, c), result.verdict.worst_at);
  if (!picture) return;
  device.pictures.push_back(*picture);
  device.pictures.back().kernel = result.kernel;
}

KernelResult run_check(Session& session, const KernelCheck& check, const Settings& settings,
                       Level level, OclgrindLog& log, DeviceResult& device,
                       const std::function<void(double)>& progress) {
  const Stopwatch watch;
  std::vector<Case> cases = settings.only_case.empty()
                                ? grid(level, check, session.info().max_work_group)
                                : std::vector<Case>{parse_case(settings.only_case)};
  for (Case& c : cases) {
    if (!settings.group_x) break;
    c.group_x = *settings.group_x;
    c.group_y = c.group_x > 0 ? 1 : 0;
  }
  CheckRun run(session, check, device);
  // One that fails soon is not worth the twins of the next.
  CaseQueue queue(check, cases, settings.stops_at_first);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    try {
      run.run(queue.next());
      const std::string found = log.take();
      if (!found.empty()) fail(ErrorKind::device, "Oclgrind: {}", found);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::usage) throw;
      run.stop_at(cases[i], error);
      break;
    }
    if (settings.stops_at_first && run.has_failed()) break;
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(cases.size()));
  }
  return run.finish(watch.seconds());
}

}  // namespace

bool DeviceResult::passed() const {
  return std::all_of(kernels.begin(), kernels.end(),
                     [](const KernelResult& k) { return k.passed(); });
}

const KernelCheck& find_check(const std::string& kernel) {
  std::vector<std::string> names;
  for (const KernelCheck& check : kernel_checks()) {
    if (kernel == check.name) return check;
    names.push_back(check.name);
  }
  fail(ErrorKind::usage, "{}", not_known(field("kernel"), kernel, names));
}

Outcome run_kernel(Session& session, const KernelCheck& check, const Case& c, const Input& input) {
  session.set_work_group(size(c.group_x), size(c.group_y));
  const bool has_bands = c.band_rows > 0;
  session.set_copies(has_bands);
  const auto memory = [&] {
    return check.memory ? check.memory(c, input) : band_memory(check.name, c, 1);
  };
  session.set_memory(has_bands ? memory() : default_memory_bytes);
  DeviceBackend device(session);
  Outcome outcome = check.run(device, c, input);
  session.set_copies(false);
  session.set_memory(default_memory_bytes);
  return outcome;
}

Run run_case(Session& session, const KernelCheck& check, const Case& c) {
  PreparedCase prepared = prepare(check, c);
  Outcome kernel = run_kernel(session, check, c, prepared.input);
  return {std::move(prepared.input), std::move(kernel), std::move(prepared.twin)};
}

DeviceResult validate_device(const DeviceInfo& info, const Settings& settings,
                             const std::function<void(double, const std::string&)>& progress) {
  OclgrindLog log(info);
  std::optional<Session> session, two_pass;  // built when a check needs them
  DeviceResult result;
  const Level level = is_simulator(info) ? Level::tiny : settings.level;
  result.device = info.name;
  result.platform = info.platform;
  result.version = info.version;
  if (is_simulator(info)) {
    result.watch = "Oclgrind looked for data races and accesses outside buffers: they FAIL too.";
  }
  result.math = settings.session.math == Math::fast ? "fast" : "strict";
  const auto checks = chosen_checks(settings);
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const auto share = [&](double done) {
      if (progress) {
        progress((static_cast<double>(i) + done) / static_cast<double>(checks.size()),
                 checks[i]->name);
      }
    };
    share(0);
    auto& own = checks[i]->needs_two_passes ? two_pass : session;
    if (!own) {
      SessionOptions options = settings.session;
      if (checks[i]->needs_two_passes) options.use_int64_atomics = false;
      own.emplace(info, options);
    }
    result.kernels.push_back(run_check(*own, *checks[i], settings, level, log, result, share));
    if (!settings.stops_at_first) add_picture(*own, *checks[i], result.kernels.back(), result);
  }
  return result;
}

}  // namespace defray::validation
