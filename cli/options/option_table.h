#pragma once
// Options as rows: everything about an option stands in its row, and what is done with options is
// done for all rows alike.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "defray/options.h"
#include "options/option_value.h"

namespace defray::cli {

/// Where an option means something.
struct Scope {
  std::vector<Method> methods = {};  ///< Empty: with all of them.
  bool literal = true;               ///< With --literal too.
  bool reference = true;             ///< With --device reference too.
};

/// Which options stand on the command line; of another command's options, none does.
using Given = std::function<bool(const std::string& name)>;

/// What else an option needs so that it can change anything.
struct Needs {
  std::function<bool(const Given&)> holds = {};
  std::string otherwise = {};  ///< What follows the option's name: "goes with --literal".
};

struct OptionDetails {
  std::string field = {};           ///< Its name in the library's errors, where it is another.
  std::optional<Scope> scope = {};  ///< Where it differs from its group's.
  Needs needs = {};
  bool is_required = false;
};

struct OptionRow {
  std::string name;  ///< "--squeeze", "-o,--output", "input".
  OptionValue value;
  std::string help;  ///< The methods and the default are added to it.
  OptionDetails details = {};
};

struct OptionGroup {
  std::string title;  ///< Empty: the options that come first.
  std::vector<OptionRow> rows;
  Scope scope = {};
};

/// What a command is asked to do it with: decides what an option can mean.
struct Setup {
  Method method = MethodSettings().method;
  bool is_literal = false, is_reference = false;
};

/// The options of a command. What the rows set must outlive it.
class OptionTable {
 public:
  OptionTable(CLI::App& command, const std::vector<OptionGroup>& groups);

  /// Sets what was given, in the order of the rows.
  void set() const;

  /// What was given, name and values, in the order of the rows; positional names are empty.
  std::vector<std::pair<std::string, std::string>> given() const;

  /// Throws Error(usage) when an option was given that can change nothing.
  void refuse_idle(const Setup& setup = {}) const;

 private:
  struct Entry {
    OptionRow row;
    Scope scope;
    CLI::Option* option;
    std::string name() const { return option->get_name(); }
    bool is_given() const { return option->count() > 0; }
  };
  bool is_given(const std::string& name) const;
  std::vector<Entry> entries_;
};

/// What the command line calls a field of the library's settings: "focus_distance_units" ->
/// "--focus" by its row, "cats_eye" -> "--cats-eye" without one.
std::string option_of_field(const std::string& field);

/// What to tell the user: options instead of fields.
std::string message_of(const Error& error);

}  // namespace defray::cli
