#pragma once
// What an option reads and where it puts it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "options/option_text.h"
#include "options/words.h"

namespace defray::cli {

/// What --quiet does, whatever the command.
inline constexpr const char* quiet_help = "No text and no progress bar, errors excepted";

struct OptionValue {
  /// Adds an option of this name that reads it.
  std::function<CLI::Option*(CLI::App&, const std::string& name)> add;
  /// Puts what was read where it belongs; the option's text is for an Error(usage).
  std::function<void(const OptionText&)> set;
  std::string default_text;  ///< For --help; empty: nothing to tell.
};

/// A value of type T (a number, a text, several) that `use` takes.
template <typename T>
OptionValue parsed(std::function<void(const T&)> use, std::string default_text = "") {
  const auto read = std::make_shared<T>();
  return {[read](CLI::App& c, const std::string& name) { return c.add_option(name, *read); },
          [read, use](const OptionText&) { use(*read); }, std::move(default_text)};
}

/// A number or a text. What stands in `target` before is its default.
template <typename T>
OptionValue value(T& target) {
  return parsed<T>([&target](const T& read) { target = read; }, fmt::format("{}", target));
}

/// The same for what has no default here, or where it is told from somewhere else.
template <typename T>
OptionValue value(std::optional<T>& target, std::string default_text = "") {
  return parsed<T>([&target](const T& read) { target = read; }, std::move(default_text));
}

template <typename T>
OptionValue values(std::vector<T>& target) {
  OptionValue several =
      parsed<std::vector<T>>([&target](const std::vector<T>& read) { target = read; },
                             fmt::format("{}", fmt::join(target, ",")));
  several.add = [add = several.add](CLI::App& c, const std::string& name) {
    return add(c, name)->delimiter(',');
  };
  return several;
}

/// A switch; given, it makes `target` this (and --name=false the contrary).
inline OptionValue flag(bool& target, bool to = true) {
  const auto read = std::make_shared<bool>();
  return {[read](CLI::App& c, const std::string& name) { return c.add_flag(name, *read); },
          [read, &target, to](const OptionText&) { target = *read == to; }, ""};
}

/// One of some words.
template <typename T>
OptionValue word(std::function<void(const T&)> use, WordTable<T> words, std::string default_text) {
  const auto read = std::make_shared<std::string>();
  return {[read, words](CLI::App& c, const std::string& name) {
            std::vector<std::string> names;
            for (const auto& [word, meaning] : words) names.push_back(word);
            return c.add_option(name, *read)->type_name(join(names, "|"));
          },
          [read, words, use](const OptionText& o) { use(choice<T>(o.name, *read, words)); },
          std::move(default_text)};
}

template <typename T>
OptionValue word(T& target, WordTable<T> words) {
  const std::string before = word_of(target, words);
  return word<T>([&target](const T& read) { target = read; }, std::move(words), before);
}

/// The same, where the option may stand without a word: `--eye`, `--eye=display`.
template <typename T>
OptionValue optional_word(std::optional<T>& target, WordTable<T> words,
                          const std::string& implied) {
  const auto read = std::make_shared<std::string>();
  return {[read, implied](CLI::App& c, const std::string& name) {
            return c.add_flag(name + "{" + implied + "}", *read);
          },
          [read, words, &target](const OptionText& o) { target = choice<T>(o.name, *read, words); },
          ""};
}

/// The same with another default to tell: what an empty value stands for, or nothing.
inline OptionValue with_default(OptionValue value, std::string text) {
  value.default_text = std::move(text);
  return value;
}

}  // namespace defray::cli
