#pragma once
// Words that stand for values.
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace defray::cli {

/// Words and what each stands for, in the order they are shown in.
template <typename T>
using WordTable = std::vector<std::pair<std::string, T>>;

/// The value that `word` names; an Error(usage) with the allowed words otherwise, and what else is:
/// ", or ...".
template <typename T>
T choice(const std::string& option, const std::string& word, const WordTable<T>& of,
         const std::string& others = "") {
  std::vector<std::string> words;
  for (const auto& [name, value] : of) {
    if (name == word) return value;
    words.push_back(name);
  }
  fail(ErrorKind::usage, "{}{}", not_known(option, word, words), others);
}

/// The word for a value; empty where there is none.
template <typename T>
std::string word_of(const T& value, const WordTable<T>& of) {
  for (const auto& [name, meaning] : of) {
    if (meaning == value) return name;
  }
  return "";
}

}  // namespace defray::cli
