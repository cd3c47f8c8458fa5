#include "tables/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/input_file.h"
#include "base/temporary_folder.h"
#include "base/text.h"
#include "image/safe_output.h"
#include "tables/markers.h"
#include "tables/tables.h"
#include "truth/places.h"

namespace defray::perf {
namespace {

struct ReportOptions {
  std::string file, scenes, device;
  std::vector<std::string> tables;
  bool is_quick = false;
};

std::vector<std::string> known_tables() {
  std::vector<std::string> names;
  for (const auto& [name, table] : readme_tables()) names.push_back(name);
  return names;
}

void check_known(const std::string& name, ErrorKind kind, const std::string& where) {
  const std::vector<std::string> known = known_tables();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  fail(kind, "{}", not_known(where + "table", name, known));
}

/// The tables to measure. Throws Error(usage, input) on names that are not there.
std::vector<std::string> chosen_tables(const ReportOptions& o) {
  for (const std::string& name : o.tables) check_known(name, ErrorKind::usage, "");
  const std::vector<std::string> marked = marked_names(text_of(o.file), o.file);
  for (const std::string& name : marked) check_known(name, ErrorKind::input, o.file + ": ");
  if (marked.empty()) {
    fail(ErrorKind::input, "{}: has no markers like '<!-- accuracy:begin -->'. Tables: {}", o.file,
         join(known_tables(), " "));
  }
  for (const std::string& name : o.tables) {
    if (std::find(marked.begin(), marked.end(), name) == marked.end()) {
      fail(ErrorKind::input, "{}: has no markers of table '{}', only of: {}", o.file, name,
           join(marked, " "));
    }
  }
  return o.tables.empty() ? marked : o.tables;
}

int run(const ReportOptions& o) {
  const std::vector<std::string> names = chosen_tables(o);
  check_scenes(o.scenes);
  check_can_write(o.file);
  setenv("RUSTICL_ENABLE", "llvmpipe", 0);  // as 'validate --all': Mesa hides its CPU device
  Session session(select_device(o.device));
  const TemporaryFolder pictures("defray-report");
  const bool is_terminal = isatty(STDERR_FILENO) == 1;
  const auto step = [&](const std::string& what) {
    if (is_terminal) fmt::print(stderr, "\r\033[K{}", what);
  };
  DeviceBackend backend(session);
  TableBench bench({pictures.path(), backend, o.is_quick, step, o.scenes});
  for (const std::string& name : names) {
    Figures figures = readme_tables().at(name).measure(bench);
    figures.notes.push_back(fmt::format("Measured on {}, {} compute units.", session.info().name,
                                        session.info().compute_units));
    if (o.is_quick) figures.notes.push_back("A rehearsal (`--quick`): these figures mean nothing.");
    // Read anew: measuring takes minutes, in which the file may have been edited.
    write_text(o.file, with_marked(text_of(o.file), o.file, name, to_markdown(figures)));
    step("");
    fmt::print("{}: {}\n", o.file, name);
    if (std::fflush(stdout) != 0) fail(ErrorKind::output, "cannot write to standard output");
  }
  return 0;
}

std::string about_report() {
  std::string text = "Tables:\n";
  for (const auto& [name, table] : readme_tables()) {
    text += fmt::format("  {:11} {}\n", name, table.about);
  }
  return text + "\nExample: defray-perf report --update perf/README.md --table accuracy,left";
}

}  // namespace

std::function<int()> add_report(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "report", "Measure tables of figures and write them into a README, between their markers");
  auto o = std::make_shared<ReportOptions>();
  command
      ->add_option("--update", o->file,
                   "File with markers, <!-- NAME:begin --> and <!-- NAME:end --> on their lines")
      ->required();
  command
      ->add_option("--table", o->tables,
                   "Only these tables, comma-separated; default: all whose markers are there")
      ->delimiter(',');
  command->add_option("--scenes", o->scenes, std::string("accuracy, prediction: ") + scenes_help);
  command->add_option("--device", o->device, "Index or part of the name of 'defray devices'");
  command->add_flag("--quick", o->is_quick, "A quarter of the size, few repetitions: a rehearsal");
  command->footer(about_report());
  return [o] { return run(*o); };
}

}  // namespace defray::perf
