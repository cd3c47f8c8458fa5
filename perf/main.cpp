// defray-perf: the published experiments, and the READMEs' tables of figures.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>

#include "base/error.h"
#include "base/text.h"
#include "device/device_backend.h"
#include "exit_code.h"
#include "experiments.h"
#include "image/safe_output.h"
#include "keep_memory.h"
#include "tables/report.h"
#include "truth/places.h"

namespace defray::perf {
namespace {

struct Options {
  std::vector<std::string> names;
  std::string folder, device, scenes;
  bool is_quick = false;
};

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const auto& [name, experiment] : experiments()) names.push_back(name);
  return names;
}

/// The experiments to run, "all" spelt out. Throws Error(usage) on an unknown name.
std::vector<std::string> chosen_names(const std::vector<std::string>& words) {
  std::vector<std::string> known = known_names();
  known.push_back("all");
  bool is_all = false;
  for (const std::string& word : words) {
    if (std::find(known.begin(), known.end(), word) == known.end()) {
      fail(ErrorKind::usage, "{}", not_known("experiment", word, known));
    }
    is_all = is_all || word == "all";
  }
  return is_all ? known_names() : words;
}

int run(const Options& o) {
  const std::vector<std::string> names = chosen_names(o.names);
  if (!o.scenes.empty() && std::find(names.begin(), names.end(), "silhouettes") == names.end()) {
    fail(ErrorKind::usage, "--scenes is for the experiment 'silhouettes'");
  }
  check_scenes(o.scenes);
  create_folder(o.folder);
  check_can_write(o.folder + "/index.html");
  Session session(select_device(o.device));
  DeviceBackend backend(session);
  const bool is_terminal = isatty(STDERR_FILENO) == 1;
  std::vector<Section> sections;
  for (const std::string& name : names) {
    const auto step = [&](const std::string& what) {
      if (is_terminal) fmt::print(stderr, "\r\033[K{}: {}", name, what);
    };
    sections.push_back(experiments().at(name).run({o.folder, backend, o.is_quick, step, o.scenes}));
    if (is_terminal) fmt::print(stderr, "\r\033[K");
    // Small pictures have small circles of confusion: what they show is not what the papers saw.
    if (o.is_quick) sections.back().findings = {"a rehearsal (--quick): its figures mean nothing"};
    for (const std::string& finding : sections.back().findings) {
      fmt::print("{}: {}\n", name, finding);
    }
    std::fflush(stdout);
  }
  write_page(o.folder,
             {"defray: the papers' experiments",
              fmt::format("Measured on {}, {}. Times are medians with their spread (largest minus "
                          "smallest, in percent of the median); on a shared machine trust ratios "
                          "within one table.",
                          session.info().name, session.info().version),
              sections});
  fmt::print("{}/index.html\n", o.folder);
  if (std::fflush(stdout) != 0) fail(ErrorKind::output, "cannot write to standard output");
  return 0;
}

std::string about() {
  std::string text = "Experiments:\n";
  for (const auto& [name, e] : experiments()) text += fmt::format("  {:12} {}\n", name, e.about);
  return text +
         "  all          every one; some ten minutes on two cores\n\n"
         "Example: defray-perf experiment plate1 -o report";
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"defray-perf: the papers' experiments, measured on this machine.", "defray-perf"};
  app.require_subcommand(1);
  Options o;
  CLI::App* command = app.add_subcommand("experiment", "Run experiments, write one report");
  command->add_option("names", o.names, "Which, or all")->required();
  command->add_option("-o,--output", o.folder, "Folder for index.html, pictures, plots, CSV")
      ->required()
      ->check([](const std::string& path) { return std::string(path.empty() ? "is empty" : ""); });
  command->add_option("--device", o.device, "Index or part of the name of 'defray devices'");
  command->add_option("--scenes", o.scenes, std::string("silhouettes: ") + scenes_help);
  command->add_flag("--quick", o.is_quick, "A quarter of the size, two repetitions: a rehearsal");
  command->footer(about());
  const std::function<int()> report = add_report(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& parse_error) {
    fail(ErrorKind::usage, "{}", parse_error.what());
  }
  return command->parsed() ? run(o) : report();
}

}  // namespace

const std::map<std::string, Experiment>& experiments() {
  static const std::map<std::string, Experiment> all{
      {"plate1", {"Shinya's plate 1: what shines through an opaque bar", plate1}},
      {"plate2", {"Shinya's plate 2 and table 1: time against an accumulation buffer", plate2}},
      {"figure7", {"Shinya's figure 7: time against cells a side", figure7}},
      {"eye", {"Glatzel & Wilhelm: miniatures, artefacts, the effect's cost", eye}},
      {"tradeoff", {"Error against time for every method on three scenes", tradeoff}},
      {"layered", {"The default beside the other methods on random layers", layered}},
      {"silhouettes", {"Edges that the truth has not: the default's worst places", silhouettes}},
      {"prediction", {"Errors that renders expect beside their true ones", prediction}},
      {"splat-table1",
       {"Krivanek & Zara's table 1: point clouds, time against aperture", splat_table1}},
      {"roofline", {"Each kernel's time beside the machine's memory and arithmetic", roofline}},
      {"truth", {"What the stages around the RDB gain and cost, and what is left", truth}}};
  return all;
}

}  // namespace defray::perf

int main(int argc, char** argv) {
  defray::cli::keep_memory();
  setenv("OPENCV_OPENCL_DEVICE", "disabled", 0);
  try {
    return defray::perf::parse_and_run(argc, argv);
  } catch (const defray::Error& error) {
    fmt::print(stderr, "defray-perf: error: {}\n", error.what());
    return defray::cli::exit_code(error.kind());
  } catch (const std::system_error& error) {  // fmt's, from a broken standard output
    fmt::print(stderr, "defray-perf: error: {}\n", error.what());
    return defray::cli::exit_code(defray::ErrorKind::output);
  } catch (const std::exception& error) {
    fmt::print(stderr, "defray-perf: error: {}\n", error.what());
    return defray::cli::exit_code(defray::ErrorKind::internal);
  }
}
