// defray tune: work-groups, found once for a device, used ever after.
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "base/stopwatch.h"
#include "commands.h"
#include "image/safe_output.h"
#include "opencl/launch_table.h"
#include "progress.h"
#include "render/render_command.h"
#include "tune/tune_report.h"
#include "tune/tuner.h"

namespace defray::cli {
namespace {

constexpr const char* tune_footer =
    R"(Tries work-groups (any gives the same bits) on built-in pictures, or on yours, until the time is up, and
goes on from there the next time. What it finds is kept for the device in the cache folder
($XDG_CACHE_HOME/defray or ~/.cache/defray; T4, the schema of Kernel Tuner and KTT), and used by
render, splat and the library from then on for frames of that class: small up to 0.5 million pixels, hd up to
4, uhd beyond; narrow with circles of up to 16 px radius, wide beyond.

Examples:
  defray tune
  defray tune --budget 10m --sizes hd,uhd --methods rdb,gather,linear,splat -o report
  defray tune beauty.exr --focus 3 --fstop 2.8 --focal-length 50 --sensor-width 36
  defray tune --show)";

struct TuneCommand : RenderCommand {
  std::string budget = "60s", folder, export_to;
  std::vector<std::string> kernels, methods{"rdb"}, sizes{"hd"};
  bool shows = false, clears = false;
};

/// Of a picture's options: without one they mean nothing.
OptionGroup of_a_picture(OptionGroup group, const std::string& without) {
  std::erase_if(group.rows, [&](const OptionRow& row) { return row.name == without; });
  for (OptionRow& row : group.rows) {
    const auto before = row.details.needs;
    if (before.holds) continue;
    row.details.needs = {[](const Given& given) { return given("input"); }, "goes with a picture"};
  }
  return group;
}

std::vector<OptionGroup> tune_options(TuneCommand& job) {
  OptionGroup device = device_options(job);
  std::erase_if(device.rows, [](const OptionRow& row) {
    return row.name == "--work-group" || row.name == "--no-tuning" || row.name == "--math";
  });
  const auto is_tuning = [](const Given& given) {
    return !given("--show") && !given("--clear") && !given("--export");
  };
  const OptionDetails tunes{.needs = {is_tuning, "goes without --show, --clear and --export"}};
  return {
      {"",
       {{"input", value(job.paths.input), "A picture with depth, instead of built-in ones"},
        {"-o,--output", value(job.folder), "Folder for a report: a heat map a kernel", tunes},
        {"--budget", value(job.budget),
         "Time for all of it: 60s, 10m, 1h; one try a kernel takes longer, if need be", tunes},
        {"--kernel", values(job.kernels),
         "These kernels; without it, those that take 2 % or more of a picture", tunes},
        {"--methods", values(job.methods), "rdb, gather, linear, splat (built-in pictures)", tunes},
        {"--sizes",
         values(job.sizes),
         "Of built-in pictures: small (640x480), hd (1920x1080), uhd (3840x2160)",
         {.needs = {[is_tuning](const Given& g) { return is_tuning(g) && !g("input"); },
                    "goes without a picture, which has its own, and without --show, --clear and "
                    "--export"}}},
        {"--show", flag(job.shows), "Tell what is known of the device, and tune nothing"},
        {"--clear", flag(job.clears),
         "Forget what is known of the device, times of --budget-ms too"},
        {"--export", value(job.export_to), "Write what is known to this JSON file"},
        {"--depth",
         value(job.paths.depth),
         "Take depth from this file",
         {.needs = {[](const Given& given) { return given("input"); }, "goes with a picture"}}}}},
      of_a_picture(channel_options(job), "--channels"),
      of_a_picture(lens_options(job), "--focus-frame"),
      of_a_picture(aperture_options(job), ""),
      device,
      {"Terminal",
       {{"--json", flag(job.json), "JSON instead of text"},
        {"-q,--quiet", flag(job.quiet), quiet_help}}}};
}

void check(const TuneCommand& job) {
  const int others = int{job.shows} + int{job.clears} + int{!job.export_to.empty()};
  if (others > 1) fail(ErrorKind::usage, "--show, --clear and --export: one of them");
  if (others == 1 && !job.paths.input.empty()) {
    fail(ErrorKind::usage, "--show, --clear and --export go without a picture");
  }
  if (job.is_on_reference()) {
    fail(ErrorKind::usage, "--device reference has no work-groups");
  }
  const bool has_splat =
      std::find(job.methods.begin(), job.methods.end(), "splat") != job.methods.end();
  if (has_splat && !job.paths.input.empty()) {
    fail(ErrorKind::usage, "--methods splat goes without a picture, which is no point cloud");
  }
  for (const std::string& kernel : job.kernels) {
    std::vector<std::string> names;
    for (const Launch& launch : launch_table()) names.push_back(launch.kernel);
    if (std::find(names.begin(), names.end(), kernel) != names.end()) continue;
    fail(ErrorKind::usage, "{}", not_known("--kernel", kernel, names));
  }
}

/// The picture's own, by each method.
std::vector<Workload> own_workloads(const TuneCommand& job, Device& device) {
  check_lens(job, {std::nullopt});
  const RenderSettings settings = settings_at(job, std::nullopt);
  const FrameReport report = inspect_file(job.paths, settings);
  const auto file = std::make_shared<const PictureFile>(
      PictureFile::read(job.paths.input, settings.request, job.paths.depth));
  std::vector<Workload> all;
  for (const std::string& method : job.methods) {
    Options options = options_of(method);
    options.depth = settings.depth;
    options.nonfinite = settings.nonfinite;
    if (options.chain) options.chain->aperture = job.chain.aperture;
    all.push_back(own_workload(device, file, job.paths.input, report.lens, options));
  }
  return all;
}

std::vector<Workload> workloads(const TuneCommand& job, Device& device) {
  if (!job.paths.input.empty()) return own_workloads(job, device);
  std::vector<Workload> all;
  for (const std::string& size : job.sizes) {
    for (const std::string& method : job.methods) {
      for (Workload& one : built_in_workloads(method, size)) all.push_back(std::move(one));
    }
  }
  return all;
}

/// Throws Error(usage) for a kernel that no picture needed.
void check_ran(const TuneCommand& job, const std::set<std::string>& tuned) {
  for (const std::string& kernel : job.kernels) {
    if (tuned.contains(kernel)) continue;
    fail(ErrorKind::usage, "--kernel {}: no picture of --methods {} runs it", kernel,
         join(job.methods, ","));
  }
}

std::vector<tuning::Result> tune(const TuneCommand& job, Device& device, const std::string& path) {
  const double seconds = parse_seconds("--budget", job.budget);
  const Stopwatch watch;  // pictures are made within it
  Tuner tuner(device, path, job.kernels);
  const std::vector<Workload> all = workloads(job, device);
  ProgressBar bar(static_cast<std::size_t>(std::ceil(seconds)), "s", !job.quiet && !job.json);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double before = watch.seconds();
    const double own = std::max(seconds - before, 0.0) / static_cast<double>(all.size() - i);
    tuner.run(all[i], own, [&](double done, const std::string& best) {
      const double at = std::min(before + done, seconds);
      bar.update(static_cast<std::size_t>(at), at - std::floor(at),
                 best.empty() ? all[i].about : all[i].about + ": " + best);
    });
  }
  check_ran(job, tuner.tuned());
  return tuner.results();
}

/// What was tuned, and the times that budgets go by.
void clear(const TuneCommand& job, const tuning::Key& key) {
  nlohmann::ordered_json removed = nlohmann::ordered_json::array();
  for (const char* kind : {"tuning", "cost"}) {
    const std::string path = tuning::device_path(kind, key);
    std::error_code error;
    const bool was_there = std::filesystem::remove(path, error);
    if (error) fail(ErrorKind::output, "{} cannot be removed: {}", path, error.message());
    std::filesystem::remove(path + ".lock", error);
    if (was_there) removed.push_back(path);
    if (!job.quiet && !job.json) {
      fmt::print("{}: {}\n", path, was_there ? "removed" : "was not there");
    }
  }
  if (job.json) fmt::print("{}\n", nlohmann::ordered_json{{"removed", removed}}.dump());
}

/// Throws Error(input) where there is nothing: an older file is worth more.
void export_results(const std::string& to, const TuneReport& report) {
  if (report.results.empty()) {
    fail(ErrorKind::input, "{}: nothing is tuned, {} is not written; run 'defray tune' first",
         report.path, to);
  }
  write_text(to, to_text(report.key, report.results));
}

int run(const OptionTable& options, TuneCommand& job) {
  options.set();
  job.given = options.given();
  check(job);
  options.refuse_idle();
  finish(job);
  if (!job.folder.empty()) {
    create_folder(job.folder);
    check_can_write(job.folder + "/index.html");
  }
  Device device = Device::open(job.device, {Math::strict, false, true});
  device.set_memory(job.memory_bytes());
  TuneReport report{tuning::key_of(device.properties()), "", {}, {}};
  report.path = tuning::path_of(report.key);
  if (report.path.empty()) {
    fail(ErrorKind::output, "no folder to keep it in: set XDG_CACHE_HOME or HOME");
  }
  if (job.clears) return clear(job, report.key), 0;
  const bool exports = !job.export_to.empty();
  if (exports) check_can_write(job.export_to);
  if (job.shows || exports) {
    tuning::Tuning known =
        tuning::read(report.path, report.key, device.properties().max_work_group);
    if (!known.notice.empty()) fmt::print(stderr, "defray: note: {}\n", known.notice);
    report.results = std::move(known.results);
  } else {
    report.results = tune(job, device, report.path);
  }
  report.findings = tuning::findings(report.results, device.properties().is_gpu());
  if (exports) export_results(job.export_to, report);
  if (!job.folder.empty()) write_report(job.folder, report);
  if (job.json) {
    print_json(report);
  } else if (exports && !job.quiet) {
    fmt::print("{}\n", job.export_to);
  } else if (!job.quiet) {
    print_text(report);
  }
  return 0;
}

}  // namespace

Run add_tune(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "tune",
      "Find this device's fastest work-groups, once; render, splat and the library use them");
  command->footer(tune_footer);
  const auto job = std::make_shared<TuneCommand>();
  const OptionTable options(*command, tune_options(*job));
  return [options, job] { return run(options, *job); };
}

}  // namespace defray::cli
