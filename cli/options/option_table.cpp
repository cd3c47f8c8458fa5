#include "options/option_table.h"

#include <algorithm>
#include <map>

namespace defray::cli {
namespace {

/// Options by the fields that rows name.
std::map<std::string, std::string>& options_by_field() {
  static std::map<std::string, std::string> options;
  return options;
}

std::string names_of(const std::vector<Method>& methods) {
  std::vector<std::string> names;
  for (const Method method : methods) names.push_back(to_string(method));
  return join(names, ", ");
}

bool is_among(Method method, const std::vector<Method>& methods) {
  return std::find(methods.begin(), methods.end(), method) != methods.end();
}

/// " (gather)", " (not tiltshift)"; nothing for what goes with every method.
std::string note_of(const Scope& scope) {
  if (scope.methods.empty()) return "";
  std::vector<Method> others;
  for (const Method method : all_methods()) {
    if (!is_among(method, scope.methods)) others.push_back(method);
  }
  return others.size() == 1 ? fmt::format(" (not {})", names_of(others))
                            : fmt::format(" ({})", names_of(scope.methods));
}

/// "Samples a pass, 1 to 1024 (gather); default 32".
std::string help_of(const OptionRow& row) {
  const auto& scope = row.details.scope;
  const std::string& default_text = row.value.default_text;
  return row.help + (scope ? note_of(*scope) : "") +
         (default_text.empty() ? "" : "; default " + default_text);
}

}  // namespace

OptionTable::OptionTable(CLI::App& command, const std::vector<OptionGroup>& groups) {
  for (const OptionGroup& group : groups) {
    for (const OptionRow& row : group.rows) {
      const OptionDetails& details = row.details;
      CLI::Option* option = row.value.add(command, row.name);
      option->description(help_of(row))->default_str("")->required(details.is_required);
      if (!group.title.empty()) option->group(group.title + note_of(group.scope));
      entries_.push_back({row, details.scope.value_or(group.scope), option});
      if (details.field.empty()) continue;
      options_by_field()[details.field] = row.name.substr(0, row.name.find(','));
    }
  }
}

bool OptionTable::is_given(const std::string& name) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& entry) { return entry.name() == name && entry.is_given(); });
}

void OptionTable::set() const {
  for (const Entry& entry : entries_) {
    if (entry.is_given()) entry.row.value.set({entry.name(), entry.row.help});
  }
}

std::vector<std::pair<std::string, std::string>> OptionTable::given() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const Entry& entry : entries_) {
    if (!entry.is_given()) continue;
    const bool is_option = !entry.option->get_positional();
    const bool is_flag = entry.option->get_items_expected_max() == 0;
    const std::string values = join(entry.option->results(), ",");
    std::string name = is_option ? entry.name() : "";
    if (is_flag && values != "true") name += "=" + values;  // --eye=display
    all.emplace_back(name, is_flag ? "" : values);
  }
  return all;
}

void OptionTable::refuse_idle(const Setup& setup) const {
  for (const Entry& entry : entries_) {
    if (!entry.is_given()) continue;
    const Scope& scope = entry.scope;
    if (!scope.methods.empty() && !is_among(setup.method, scope.methods)) {
      fail(ErrorKind::usage, "{} means nothing to --method {}: it goes with {}", entry.name(),
           to_string(setup.method), names_of(scope.methods));
    }
    if (setup.is_reference && !scope.reference) {
      fail(ErrorKind::usage, "{} means nothing to --device reference", entry.name());
    }
    if (setup.is_literal && !scope.literal) {
      fail(ErrorKind::usage, "{} means nothing to --literal", entry.name());
    }
    const Needs& needs = entry.row.details.needs;
    if (needs.holds && !needs.holds([this](const auto& name) { return is_given(name); })) {
      fail(ErrorKind::usage, "{} {}", entry.name(), needs.otherwise);
    }
  }
}

std::string option_of_field(const std::string& field) {
  const auto found = options_by_field().find(field);
  if (found != options_by_field().end()) return found->second;
  std::string name = field;
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::string message_of(const Error& error) {
  return with_field_names(error.marked(), option_of_field);
}

}  // namespace defray::cli
