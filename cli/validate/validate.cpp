// defray validate: every kernel against its scalar twin, on this machine's devices.
#include "validate/validate.h"

#include <fmt/format.h>

#include <cstdlib>
#include <set>

#include "commands.h"
#include "exit_code.h"
#include "image/safe_output.h"
#include "opencl/device.h"
#include "options/math_words.h"
#include "options/option_value.h"
#include "progress.h"
#include "validate/case_command.h"
#include "validation/report.h"

namespace defray::cli {
namespace {

using namespace defray::validation;

/// An OpenCL implementation that Debian has.
struct Implementation {
  const char *platform, *package, *how;
};
constexpr Implementation implementations[] = {
    {"Portable Computing Language", "pocl-opencl-icd", ""},
    {"rusticl", "mesa-opencl-icd", " and set RUSTICL_ENABLE=llvmpipe"},
    {"Oclgrind", "oclgrind", " and run 'oclgrind defray validate'"}};

/// What --all could not try, with the package to install.
std::vector<std::string> missing_implementations(const std::vector<DeviceInfo>& devices) {
  std::set<std::string> found;
  for (const DeviceInfo& d : devices) found.insert(d.platform);
  std::vector<std::string> notes;
  for (const Implementation& i : implementations) {
    if (found.count(i.platform)) continue;
    notes.push_back(fmt::format("skipped: {} offers no device here; Debian: apt-get install {}{}",
                                i.platform, i.package, i.how));
  }
  return notes;
}

std::vector<DeviceInfo> chosen_devices(const ValidateOptions& o, std::vector<std::string>& notes) {
  if (!o.all) return {select_device(o.device)};
  // Mesa hides its CPU device unless asked for it.
  setenv("RUSTICL_ENABLE", "llvmpipe", 0);
  const std::vector<DeviceInfo> devices = list_devices();
  if (devices.empty()) select_device("");  // says what to install
  notes = missing_implementations(devices);
  return devices;
}

Settings settings_of(const ValidateOptions& o) {
  Settings s;
  s.level = o.full ? Level::full : o.tiny ? Level::tiny : Level::quick;
  s.kernels = o.kernels;
  s.only_case = o.only_case;
  s.session.math = choice<Math>("--math", o.math, math_words);
  for (const std::string& kernel : s.kernels) find_check(kernel);
  if (!o.only_case.empty()) parse_case(o.only_case);
  return s;
}

void print_device(const DeviceResult& d) {
  fmt::print("{} ({}), {} arithmetic\n", d.device, d.platform, d.math);
  if (!d.watch.empty()) fmt::print("  {}\n", d.watch);
  for (const KernelResult& k : d.kernels) {
    const Verdict& v = k.verdict;
    fmt::print(
        "  {}  {:20} {:4} cases, {:9} values, {} differing, {} beyond the rule, {} unstable\n",
        k.passed() ? "PASS" : "FAIL", k.kernel, k.cases, v.compared, v.differing, v.wrong,
        k.unstable);
    if (!k.first_wrong.empty()) {
      fmt::print("        {}\n", case_command(d, k.kernel, k.first_wrong));
    }
    if (!k.error.empty()) fmt::print("        {}\n", k.error);
  }
}

DeviceResult validate_with_progress(const DeviceInfo& info, const Settings& settings,
                                    bool has_bar) {
  ProgressBar bar(1, info.name.c_str(), has_bar);
  return validate_device(info, settings,
                         [&](double share, const std::string&) { bar.update(0, share); });
}

const char* level_of(const ValidateOptions& o) {
  if (!o.only_case.empty()) return "case";
  return o.full ? "full" : o.tiny ? "tiny" : "quick";
}

std::string summary_of(const std::vector<DeviceResult>& results) {
  std::size_t checks = 0, failed = 0, cases = 0;
  for (const DeviceResult& d : results) {
    for (const KernelResult& k : d.kernels) {
      ++checks;
      failed += k.passed() ? 0 : 1;
      cases += k.cases;
    }
  }
  return failed == 0 ? fmt::format("{} of {} checks pass, {} cases", checks, checks, cases)
                     : fmt::format("{} of {} checks FAIL, {} cases", failed, checks, cases);
}

std::string intro_of(const ValidateOptions& o) {
  const std::string input = o.only_case.empty()
                                ? fmt::format(
                                      "a grid ({}) of sizes, circles of confusion, depth "
                                      "patterns, colours, work-groups and bands",
                                      level_of(o))
                                : "one case, " + o.only_case;
  return fmt::format("OpenCL kernels against their scalar C++ twins, over {}. {}.", input,
                     version_and_date());
}

int run(const ValidateOptions& o) {
  const Settings settings = settings_of(o);
  create_folder(o.folder);
  check_can_write(o.folder + "/report.html");
  if (o.arithmetic) return run_arithmetic(o);
  std::vector<std::string> notes;
  std::vector<DeviceResult> results;
  bool passed = true;
  for (const DeviceInfo& info : chosen_devices(o, notes)) {
    results.push_back(validate_with_progress(info, settings, !o.quiet));
    passed = passed && results.back().passed();
    if (o.has_text()) print_device(results.back());
    std::fflush(stdout);
  }
  if (o.has_text()) {
    for (const std::string& note : notes) fmt::print("{}\n", note);
  }
  const TemporaryFolder pictures("defray-report");
  const Page page{"defray: " + summary_of(results), intro_of(o),
                  to_sections(results, notes, pictures.path(), case_command)};
  write_reports(o, page, pictures, to_json(results, notes, level_of(o), case_command));
  if (o.has_text()) fmt::print("{}\n", summary_of(results));
  return passed ? ExitCode::ok : ExitCode::failed;
}

}  // namespace

Run add_validate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "validate", "Check every kernel against its scalar twin on this machine's devices");
  auto o = std::make_shared<ValidateOptions>();
  command->add_option("-o,--output", o->folder, "Folder for report.html and report.json")
      ->required();
  auto* device =
      command->add_option("--device", o->device, "OpenCL device: an index or a part of its name");
  auto* all = command->add_flag("--all", o->all, "Every device of every implementation");
  all->excludes(device);
  auto* quick = command->add_flag("--quick", o->quick, "Within a minute on two cores (default)");
  auto* full = command->add_flag("--full", o->full, "Every pattern with every size; some minutes");
  auto* tiny = command->add_flag("--tiny", o->tiny,
                                 "Small frames alone, as simulators get: seconds on slow devices");
  full->excludes(quick)->excludes(tiny);
  tiny->excludes(quick);
  auto* kernel =
      command->add_option("--kernel", o->kernels, "Only these kernels, comma-separated or repeated")
          ->delimiter(',');
  auto* only = command->add_option("--case", o->only_case, "Only this case, as a report gives it");
  only->excludes(quick)->excludes(full)->excludes(tiny);
  auto* math =
      command->add_option("--math", o->math, "strict, or fast to see which rules it breaks");
  command
      ->add_flag("--arithmetic", o->arithmetic,
                 "Measure instead what relaxed arithmetic buys and costs: minutes")
      ->excludes(all)
      ->excludes(tiny)
      ->excludes(kernel)
      ->excludes(only)
      ->excludes(math);
  command->add_flag("--json", o->json, "Print report.json instead of text");
  command->add_flag("-q,--quiet", o->quiet, quiet_help);
  command->footer(
      "PASS: every value within the kernel's rule, and the same bits in a second run.\n"
      "Exit code: 0 all pass, 1 a kernel fails.\n"
      "Examples:\n"
      "  defray validate -o report\n"
      "  defray validate --all --full -o report\n"
      "  defray validate --kernel rdb_merge --case 257x89,ties,coc=8,wild,cells=5,seed=3 -o "
      "report\n"
      "  defray validate --arithmetic -o report");
  return [o] { return run(*o); };
}

}  // namespace defray::cli
