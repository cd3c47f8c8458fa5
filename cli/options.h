#pragma once
// What commands share on the command line.
#include <map>
#include <string>

#include "base/error.h"
#include "base/text.h"
#include "opencl/session.h"

namespace defray::cli {

/// The value that `word` names; an Error(usage) with the allowed words otherwise.
template <typename T>
T choice(const std::string& option, const std::string& word, const std::map<std::string, T>& of) {
  const auto found = of.find(word);
  if (found != of.end()) return found->second;
  std::vector<std::string> words;
  for (const auto& [name, value] : of) words.push_back(name);
  fail(ErrorKind::usage, "{} '{}' is not known.{} Allowed: {}", option, word,
       did_you_mean(word, words), join(words, " "));
}

inline const std::map<std::string, Math> math_words{{"strict", Math::strict}, {"fast", Math::fast}};

}  // namespace defray::cli
