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
#include "base/text.h"
#include "commands.h"
#include "defray/defray.h"
#include "end_on_signals.h"
#include "exit_code.h"
#include "options/option_table.h"
#include "standard_streams.h"

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

'defray COMMAND --help' explains a command.
Exit codes: 0 done; 1 some frames failed, a bound or target was missed, or a kernel failed; 2 wrong usage;
3 bad input; 4 output not written; 5 no OpenCL device or an OpenCL error; 70 a bug in defray;
130, 143 interrupted, terminated.)";

/// Every option name, or every command name, that `app` knows.
std::vector<std::string> known_words(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    for (const std::string& name : option->get_snames()) words.push_back("-" + name);
  }
  for (const CLI::App* sub : app.get_subcommands({})) words.push_back(sub->get_name());
  return words;
}

/// " There are --aperture-diameter, --aperture-image." for words that go on like this one, or
/// " Did you mean '--rays'?"; an aperture can be an f-number too.
std::string continued(const std::string& word, const std::vector<std::string>& known) {
  if (!word.starts_with("--") || word.size() < 4) return "";
  std::vector<std::string> longer;
  for (const std::string& name : known) {
    if (name.starts_with(word)) longer.push_back(name);
  }
  if (word == "--aperture") longer.insert(longer.begin(), "--fstop");
  if (longer.size() == 1) return " Did you mean '" + longer.front() + "'?";
  return longer.empty() ? "" : " There are " + join(longer, ", ") + ".";
}

bool is_picture(const std::string& word) {
  const std::string extension = lower_extension(word);
  for (const char* known : {".exr", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".hdr"}) {
    if (extension == known) return word[0] != '-';
  }
  return false;
}

/// "unknown option '--focsu'. Did you mean '--focus'?"
std::string explain_extras(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  const CLI::App& scope = chosen.empty() ? app : *chosen.front();
  const std::vector<std::string> extras = app.remaining(true);
  std::string word = extras.empty() ? "" : extras.front();
  word = word.substr(0, word.find('='));
  const char* kind = word.rfind('-', 0) == 0 ? "option" : chosen.empty() ? "command" : "argument";
  const std::string help =
      chosen.empty() ? "defray --help" : "defray " + scope.get_name() + " --help";
  std::string hint = continued(word, known_words(scope));
  if (hint.empty()) hint = did_you_mean(word, known_words(scope));
  if (is_picture(word)) {
    hint =
        " Several pictures? A sequence is one name with #### for its numbers, in quotes: "
        "'shot.####.exr'.";
  }
  return fmt::format("unknown {} '{}'.{} See '{}'.", kind, word, hint, help);
}

/// "--cats-eye: 'abc' cannot be read as a number. Vignetting: offset of ..."; other errors as they
/// are.
std::string explain_value(const CLI::ParseError& error, const CLI::App& app) {
  const std::string message = error.what();
  const auto has = [&](const std::string& part) { return message.find(part) != std::string::npos; };
  const CLI::Option* option = nullptr;
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* o : command->get_options()) {
      const bool is_longer = !option || o->get_name().size() > option->get_name().size();
      if (has(o->get_name()) && is_longer) option = o;
    }
  }
  if (!option) return message;
  const auto explain = [&](const std::string& what) {
    return fmt::format("{}: {}. {}", option->get_name(), what, option->get_description());
  };
  if (has("Could not convert")) {
    const std::string type = option->get_type_name();
    return explain(fmt::format("'{}' cannot be read as {}", join(option->results(), ","),
                               type.empty()      ? "true or false"
                               : type == "FLOAT" ? "a number"
                                                 : "a whole number"));
  }
  if (option && message == option->get_name() + " is required") {
    return fmt::format("{} is missing: {}. See 'defray {} --help'", option->get_name(),
                       option->get_description(), app.get_subcommands().front()->get_name());
  }
  if (has("required") && has("missing")) return explain("a value is missing");
  if (has("required but received")) return explain("it is given more than once");
  return message;
}

int fail_with(ErrorKind kind, const std::string& message) {
  print_error("defray: error: " + message);
  return exit_code(kind);
}

/// A shell's unset variable must not pass for an option that was left out.
void refuse_empty_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (!value.empty()) continue;
      fail(ErrorKind::usage, "{} is empty: give a value, or leave the option out",
           option->get_name());
    }
  }
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
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    return fail_with(ErrorKind::usage, explain_extras(app));
  } catch (const CLI::CallForHelp& help) {
    return print_and_end(app, help);
  } catch (const CLI::CallForVersion& version) {
    return print_and_end(app, version);
  } catch (const CLI::ParseError& error) {
    return fail_with(ErrorKind::usage, explain_value(error, app));
  }
  for (const auto& [app_of, command] : commands) {
    if (!app_of->parsed()) continue;
    refuse_empty_values(*app_of);
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
