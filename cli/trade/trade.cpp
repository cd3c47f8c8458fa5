// defray trade: what speed costs in accuracy, on the user's own picture.
#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "base/temporary_folder.h"
#include "chain/quality.h"
#include "commands.h"
#include "defray/defray.h"
#include "image/safe_output.h"
#include "image/sequence.h"
#include "open_device.h"
#include "options/shell_quoted.h"
#include "prediction/with_error.h"
#include "progress.h"
#include "render/render_command.h"
#include "standard_streams.h"
#include "trade/trade_report.h"
#include "trade/trade_truth.h"

namespace defray::cli {
namespace {

constexpr const char* trade_footer =
    R"(Renders one picture in every quality and between them, as --target-db would where one is given,
and by the other methods where there is a truth, --runs times each:
pictures, a plot of error against time (trade.png), a table with the command of each (index.html,
trade.csv). Errors are expected ones, told from how the pictures look, and true ones with --truth.

Examples:
  defray trade beauty.exr -o trade --focus 3 --fstop 2.8 --focal-length 50 --sensor-width 36
  defray trade beauty.exr -o trade --camera camera.json --truth lens.exr --target-db 38)";

constexpr int most_runs = 1000;

struct TradeCommand : RenderCommand {
  std::string folder, truth;
  std::optional<double> target_db;
  int runs = 3;
};

struct Candidate {
  std::string name, options;
  MethodSettings method;  ///< Without stages: beside the others, where the truth tells of it.
  std::optional<double> target_db = {};
};

/// What --target-db and --budget-ms choose from, a few of them: every quality, and lens points
/// between those of one and the next.
constexpr std::array<Rung, 3> between{Rung{Quality::draft, 13}, Rung{Quality::normal, 18},
                                      Rung{Quality::normal, 25}};

std::vector<Candidate> of_quality(Quality quality, const TradeCommand& job) {
  const std::string word = to_string(quality);
  MethodSettings method = job.settings.method;
  method.chain = settings_for(quality);
  method.chain->aperture = job.chain.aperture;
  std::vector<Candidate> all{{word, "--quality " + word, method}};
  for (const Rung& rung : between) {
    if (rung.quality != quality) continue;
    method.chain->cells_per_side = rung.cells_per_side;
    all.push_back({fmt::format("{}-{}", word, rung.cells_per_side),
                   fmt::format("--quality {} --rdb {}", word, rung.cells_per_side), method});
  }
  return all;
}

/// The front of every quality, and what the target takes, which has to look for its quality; with a
/// truth, which alone tells of them, the other methods.
std::vector<Candidate> candidates(const TradeCommand& job) {
  std::vector<Candidate> all;
  for (const Quality quality : all_qualities) {
    for (Candidate& c : of_quality(quality, job)) all.push_back(std::move(c));
  }
  if (job.target_db) {
    const MethodSettings method = of_quality(Quality::normal, job).front().method;
    all.push_back({"target", fmt::format("--target-db {}", *job.target_db), method, job.target_db});
  }
  // Bokeh of another shape than a circle is of the stages alone.
  if (job.truth.empty() || job.chain.aperture != Aperture()) return all;
  MethodSettings other = job.settings.method;
  other.chain.reset();
  all.push_back({"literal", "--literal", other});
  other.method = Method::gather;
  all.push_back({"gather", "--method gather", other});
  other.method = Method::linear;
  all.push_back({"linear", "--method linear", other});
  return all;
}

/// What is of other channels, and of sequences, is not here.
OptionGroup without(OptionGroup group, const std::string& name) {
  std::erase_if(group.rows, [&](const OptionRow& row) { return row.name == name; });
  return group;
}

std::vector<OptionGroup> trade_options(TradeCommand& job) {
  return {{"",
           {{"input",
             value(job.paths.input),
             "Colour, and depth unless --depth is given",
             {.is_required = true}},
            {"-o,--output", value(job.folder), "Folder for what is made", {.is_required = true}},
            {"--depth", value(job.paths.depth), "Take depth from this file"},
            {"--truth", value(job.truth), "What the lens really gives, for true errors"},
            {"--target-db",
             value(job.target_db),
             "Recommend the fastest that meets this PSNR, dB",
             {.field = "target_db"}},
            {"--runs", value(job.runs), "Renders of each, whose median time counts, 1 to 1000"}}},
          without(channel_options(job), "--channels"),
          without(lens_options(job), "--focus-frame"),
          {"", {full_size_row(job)}},
          aperture_options(job),
          device_options(job),
          {"Terminal",
           {{"--json", flag(job.json), "JSON instead of text"},
            {"-q,--quiet", flag(job.quiet), quiet_help}}}};
}

/// The same picture by `render`.
std::string command_of(const TradeCommand& job, const Candidate& candidate) {
  const std::set<std::string> own{"--output", "--truth", "--target-db",
                                  "--runs",   "--json",  "--quiet"};
  return render_command_line(job.given, [&](const auto& name) { return own.contains(name); }) +
         " -o " + shell_quoted(job.folder + "/" + candidate.name + ".exr") + " " +
         candidate.options;
}

/// Renders it so many times, into this folder.
TradePoint measured(const TradeCommand& job, const Candidate& candidate,
                    const RenderSettings& common, const std::optional<ColourFile>& truth,
                    const std::string& folder, Device& device, const Progress& progress) {
  RenderSettings settings = common;
  settings.method = candidate.method;
  settings.error.wants_expected = true;
  settings.error.target_db = candidate.target_db;
  FramePaths paths = job.paths;
  paths.output = folder + "/" + candidate.name + ".png";
  std::vector<double> seconds;
  FrameResult result;
  for (int run = 0; run < job.runs; ++run) {
    FileRender frame(paths, settings);
    frame.read();
    frame.render(device, [&](double share) { progress((run + share) / job.runs); });
    result = frame.write();
    // What is expected tells a target's search how to go on.
    const double search = candidate.target_db ? result.report.predict_seconds : 0;
    seconds.push_back(result.report.render_seconds + search);
  }
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  TradePoint point{candidate.name,
                   command_of(job, candidate),
                   median,
                   (seconds.back() - seconds.front()) / median,
                   result.report.expected,
                   {},
                   candidate.target_db.has_value()};
  if (truth) point.true_db = true_db_of(*truth, result);
  return point;
}

/// Throws Error(usage) where something that is read would be written.
void check_files(const TradeCommand& job, const std::vector<Candidate>& all) {
  std::vector<std::string> written{"index.html", "trade.csv", "trade.png"};
  for (const Candidate& c : all) written.insert(written.end(), {c.name + ".png", c.name + ".exr"});
  for (const std::string& input :
       {job.paths.input, job.paths.depth, job.truth, job.camera, job.chain.aperture.image}) {
    for (const std::string& name : written) {
      const std::string path = job.folder + "/" + name;
      if (!input.empty() && is_same_file(input, path)) {
        fail(ErrorKind::usage, "{}: is read and would be written; choose another folder", input);
      }
    }
  }
}

/// Before anything is rendered. The truth, where there is one.
std::optional<ColourFile> check(const TradeCommand& job, const std::vector<Candidate>& all) {
  if (has_frame_pattern(job.paths.input) &&
      job.paths.input.find_first_of("#%") != std::string::npos) {
    fail(ErrorKind::usage, "{}: trade takes one picture; name one of the frames", job.paths.input);
  }
  for (const std::string& path : {job.paths.input, job.truth, job.folder}) {
    if (path == "-") {
      fail(ErrorKind::usage, "trade reads files several times and writes a folder: '-' is neither");
    }
  }
  validate(job.settings.method, {false, false, job.target_db});
  if (job.runs < 1 || job.runs > most_runs) {
    fail(ErrorKind::usage, "--runs is {}: it must be 1 to {}", job.runs, most_runs);
  }
  check_lens(job, {std::nullopt});
  check_files(job, all);
  const FrameReport input = inspect_file(job.paths, settings_at(job, std::nullopt));
  for (const std::string& note : input.notes) {
    if (!job.quiet) print_error("defray: note: " + with_field_names(note, option_of_field));
  }
  std::optional<ColourFile> truth;
  if (!job.truth.empty()) {
    truth.emplace(read_truth(job.truth, job.settings.request));
    check_truth(job.truth, *truth, job.paths.input, input);
  }
  create_folder(job.folder);
  check_can_write(job.folder + "/index.html");
  return truth;
}

/// Throws what `measure` throws, but for a method beside the others that has a limit of its own: it
/// is left out, with a note.
template <typename Measure>
void add_point(const TradeCommand& job, const Candidate& candidate, Trade& trade,
               const Measure& measure) {
  try {
    trade.points.push_back(measure());
  } catch (const Error& error) {
    if (candidate.method.chain || error.kind() != ErrorKind::usage) throw;
    if (!job.quiet) {
      print_error(fmt::format("defray: note: {} is left out: {}", candidate.name,
                              with_field_names(error.marked(), option_of_field)));
    }
  }
}

int run(const OptionTable& options, TradeCommand& job) {
  options.set();
  job.given = options.given();
  options.refuse_idle({Method::rdb, false, job.is_on_reference()});
  finish(job);
  const std::vector<Candidate> all = candidates(job);
  const std::optional<ColourFile> truth = check(job, all);
  Device device = open_device(job.device, {job.math, !job.no_tuning}, job.quiet);
  if (!job.is_on_reference()) device.set_memory(job.memory_bytes());
  const RenderSettings settings = settings_at(job, std::nullopt);
  ProgressBar bar(all.size(), "pictures", !job.quiet && !job.json);
  Trade trade{job.paths.input, device.name(), !job.truth.empty(), {}, 0, ""};
  const TemporaryFolder made("defray-trade");  // a run that is interrupted changes nothing
  for (std::size_t i = 0; i < all.size(); ++i) {
    add_point(job, all[i], trade, [&] {
      return measured(job, all[i], settings, truth, made.path(), device,
                      [&](double share) { bar.update(i, share); });
    });
  }
  bar.clear();
  recommend(trade, job.target_db);
  write_report(job.folder, trade, made.path());
  if (job.json) {
    print_json(trade);
  } else if (!job.quiet) {
    print_text(trade);
    fmt::print("  {}/index.html\n", job.folder);
  }
  return 0;
}

}  // namespace

Run add_trade(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "trade", "What speed costs in accuracy: one picture in every quality, with errors and times");
  command->footer(trade_footer);
  const auto job = std::make_shared<TradeCommand>();
  const OptionTable options(*command, trade_options(*job));
  return [options, job] { return run(options, *job); };
}

}  // namespace defray::cli
