#include "usage_error.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace defray::cli {
namespace {

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
    if (extension == known) return true;
  }
  return false;
}

/// What other programs, and our own JSON, call an option of ours; empty: nothing.
std::string by_another_name(const std::string& word, const std::vector<std::string>& known) {
  static const std::map<std::string, std::string> names{
      {"--anamorphic", "--squeeze"},   {"--bit-depth", "--bits"},
      {"--bokeh", "--aperture-image"}, {"--f-number", "--fstop"},
      {"--focal-distance", "--focus"}, {"--focus-distance", "--focus"},
      {"--iris-blades", "--blades"},   {"--z-channel", "--depth-channel"}};
  const auto found = names.find(word);
  const bool is_here =
      found != names.end() && std::find(known.begin(), known.end(), found->second) != known.end();
  return is_here ? " Did you mean '" + found->second + "'?" : "";
}

std::string about_option(const std::string& word, const CLI::App& scope) {
  if (!word.starts_with("--") && is_picture(word)) return " A file of that name is ./" + word + ".";
  const std::vector<std::string> known = known_words(scope);
  if (std::string other = by_another_name(word, known); !other.empty()) return other;
  const std::string hint = continued(word, known);
  const bool is_letter = word.size() < 3;  // any other is as near
  return hint.empty() && !is_letter ? did_you_mean(word, known) : hint;
}

/// The option that was given without the word it may have: --eye.
const CLI::Option* flag_without_word(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const bool is_flag = option->get_items_expected_max() == 0 && option->count() == 1;
    if (!is_flag) continue;
    const std::string implied = option->results().front();
    if (implied != "true" && implied != "false") return option;
  }
  return nullptr;
}

/// " compare takes a and b."
std::string about_places(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) names.push_back(option->get_name());
  }
  return fmt::format(" {} takes {}.", command.get_name(),
                     names.empty()       ? "options alone"
                     : names.size() == 1 ? "one: " + names.front()
                                         : join(names, " and "));
}

/// What was meant by an argument too many.
std::string about_argument(const std::string& word, const CLI::App& command) {
  const bool is_word =
      std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isalpha(c); });
  const CLI::Option* flag = is_word ? flag_without_word(command) : nullptr;
  if (flag) return fmt::format(" A word of {0} follows a =: {0}={1}.", flag->get_name(), word);
  const bool takes_sequences = command.get_option_no_throw("--frames") != nullptr;
  const char* const sequence =
      is_picture(word) && takes_sequences
          ? " Several pictures? A sequence is one name with #### for its numbers, in quotes: "
            "'shot.####.exr'."
          : "";
  return about_places(command) + sequence;
}

/// "unknown option '--focsu'. Did you mean '--focus'?"
std::string explain_extra(std::string word, const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  const CLI::App& scope = chosen.empty() ? app : *chosen.front();
  word = word.substr(0, word.find('='));
  const bool is_option = word.starts_with('-'), is_command = chosen.empty() && !is_option;
  const std::string hint = is_option    ? about_option(word, scope)
                           : is_command ? did_you_mean(word, known_words(scope))
                                        : about_argument(word, scope);
  return fmt::format("unknown {} '{}'.{} See 'defray {}--help'.",
                     is_option    ? "option"
                     : is_command ? "command"
                                  : "argument",
                     word, hint, chosen.empty() ? "" : scope.get_name() + " ");
}

/// "--amplify: 'abc' cannot be read as a number like 2.5, without a unit. The sheet's difference
/// is ..."; other errors as they are.
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
    const std::string what = type.empty()      ? "true or false"
                             : type == "FLOAT" ? "a number like 2.5, without a unit"
                                               : "a whole number";
    return explain(fmt::format("'{}' cannot be read as {}", join(option->results(), ","), what));
  }
  if (option && message == option->get_name() + " is required") {
    return fmt::format("{} is missing: {}. See 'defray {} --help'", option->get_name(),
                       option->get_description(), app.get_subcommands().front()->get_name());
  }
  if (has("required") && has("missing")) return explain("a value is missing");
  if (has("required but received")) return explain("it is given more than once");
  return message;
}

bool is_option_of(const CLI::App& command, const std::string& value) {
  const std::vector<std::string> known = known_words(command);
  return value.starts_with('-') &&
         std::find(known.begin(), known.end(), value.substr(0, value.find('='))) != known.end();
}

/// What is no value though it was read as one.
std::string explain_no_value(const CLI::Option& option, const CLI::App& command) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string name = option.get_name();
  for (const std::string& value : option.results()) {
    // A shell's unset variable must not pass for an option that was left out.
    if (value.empty()) {
      return fmt::format("{} is empty: give a value{}", name,
                         option.get_required() ? "" : ", or leave the option out");
    }
    if (is_option_of(command, value)) {
      return fmt::format("{}: a value is missing. {}", name, option.get_description());
    }
  }
  return "";
}

/// Of the first such option.
std::string explain_no_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string why = explain_no_value(*option, command);
    if (!why.empty()) return why;
  }
  return "";
}

}  // namespace

std::string explain_usage_error(const CLI::ParseError& error, const CLI::App& app) {
  // They took what another lacks now, or left it over.
  for (const CLI::App* command : app.get_subcommands()) {
    const std::string why = explain_no_values(*command);
    if (!why.empty()) return why;
  }
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error);
  for (const std::string& extra : app.remaining(true)) {
    if (is_extra || extra.starts_with('-')) return explain_extra(extra, app);
  }
  return explain_value(error, app);
}

void refuse_no_values(const CLI::App& command) {
  const std::string why = explain_no_values(command);
  if (!why.empty()) fail(ErrorKind::usage, "{}", why);
}

}  // namespace defray::cli
