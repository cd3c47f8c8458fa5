// defray: reads the command line, runs one command, turns an Error into one line and an exit code.
#include "run.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error.h"
#include "commands.h"
#include "defray/defray.h"
#include "end_on_signals.h"
#include "exit_code.h"
#include "help.h"
#include "options/option_table.h"
#include "standard_streams.h"
#include "usage_error.h"

namespace defray::cli {
namespace {

constexpr const char* what_it_is =
    R"(defray: depth of field for pinhole renders with depth, on OpenCL.

It turns a picture with depth into the picture a real lens takes, and can say how far from the
truth a fast setting is.)";

constexpr const char* examples = R"(Examples:
  defray render beauty.exr -o out.exr --focus 3 --fstop 2.8 --focal-length 50
  defray render 'shot.####.exr' -o 'out/shot.####.exr' --frames 1-8 --camera camera.json
  defray devices

'defray help COMMAND' explains a command.
Exit codes: 0 done; 1 some frames failed, a bound or target was missed, or a kernel failed; 2 wrong usage;
3 bad input; 4 output not written; 5 no OpenCL device or an OpenCL error; 70 a bug in defray;
130, 143 interrupted, terminated.)";

int fail_with(ErrorKind kind, const std::string& message) {
  print_error("defray: error: " + message);
  return exit_code(kind);
}

/// Commands of which nothing is left but what they print; others write files beside it, or say by
/// their exit code whether a bound is kept.
bool is_for_its_text(const CLI::App& command) {
  const std::string name = command.get_name();
  const auto has_any = [&](const std::vector<const char*>& options) {
    return std::any_of(options.begin(), options.end(),
                       [&](const char* option) { return command.count(option) > 0; });
  };
  if (name == "compare") {
    return !has_any({"--sheet", "--min-psnr", "--min-ssim", "--max-error", "--max-false-edges",
                     "--max-false-changes"});
  }
  if (name == "psf") return !has_any({"--output", "--csv"});
  if (name == "tune") return has_any({"--show"});
  return name == "info" || name == "devices";
}

/// Help, or the version.
int print_and_end(const CLI::App& app, const CLI::Success& what) {
  const int code = app.exit(what);
  return is_output_lost() || was_output_closed()
             ? fail_with(ErrorKind::output, "cannot write to standard output")
             : code;
}

/// As tables of options have them: "Pixels; default 640" instead of "INT=640".
void put_defaults_into_texts(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) {
    for (CLI::Option* option : command->get_options()) {
      const std::string text = option->get_default_str();
      if (!text.empty() && text != "[]") {  // no values
        option->description(option->get_description() + "; default " + text);
      }
      option->default_str("");
    }
  }
}

int run_command(int argc, char** argv) {
  CLI::App app{what_it_is, "defray"};
  app.formatter(help_format());  // before the commands, which take it over
  app.footer(examples);
  app.set_version_flag("--version", std::string("defray ") + version());
  app.option_defaults()->always_capture_default();
  std::vector<std::pair<CLI::App*, Run>> commands;
  for (const auto add : {add_render, add_splat, add_trade, add_tune, add_info, add_devices,
                         add_scene, add_compare, add_sheet, add_psf, add_validate}) {
    const Run command = add(app);
    commands.emplace_back(app.get_subcommands({}).back(), command);
  }
  put_defaults_into_texts(app);
  try {
    app.parse(arguments_of(argc, argv, app));
  } catch (const CLI::CallForHelp& help) {
    return print_and_end(app, help);
  } catch (const CLI::CallForVersion& version) {
    return print_and_end(app, version);
  } catch (const CLI::ParseError& error) {
    return fail_with(ErrorKind::usage, explain_usage_error(error, app));
  }
  for (const auto& [app_of, command] : commands) {
    if (!app_of->parsed()) continue;
    refuse_no_values(*app_of);
    const int code = command();
    if (is_output_lost() || (was_output_closed() && is_for_its_text(*app_of))) {
      return fail_with(ErrorKind::output, "cannot write to standard output");
    }
    return code;
  }
  fmt::print("{}", app.help());
  return ExitCode::wrong_usage;
}

}  // namespace

int run(int argc, char** argv) {
  // OpenCV must not open an OpenCL context of its own beside ours.
  setenv("OPENCV_OPENCL_DEVICE", "disabled", 0);
  open_standard_streams();
  end_on_signals();
  try {
    return run_command(argc, argv);
  } catch (const Error& error) {
    return fail_with(error.kind(), message_of(error));
  } catch (const std::bad_alloc&) {
    return fail_with(ErrorKind::input, "not enough memory for this picture");
  } catch (const std::system_error& error) {  // fmt's, from a broken standard output
    return is_output_lost() ? fail_with(ErrorKind::output, error.what()) : ExitCode::ok;
  } catch (const std::exception& error) {
    return fail_with(ErrorKind::internal, error.what());
  }
}

}  // namespace defray::cli
