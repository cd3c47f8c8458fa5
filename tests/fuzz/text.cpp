// Spelling suggestions. First line: a word; the others: what it could have been.
#include "base/text.h"

#include <algorithm>
#include <cctype>

#include "fuzz.h"

using namespace defray;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const std::string word = bytes.line();
  std::vector<std::string> known;
  while (!bytes.is_empty()) known.push_back(bytes.line());
  const std::string nearest = nearest_spelling(word, known);
  fuzz::require(nearest.empty() || std::count(known.begin(), known.end(), nearest) > 0);
  // A word that is known is nearest to itself, whatever its case; what has no letter is no word.
  const bool is_word =
      std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
  if (is_word && std::count(known.begin(), known.end(), word) > 0) {
    fuzz::require(lower_case(nearest) == lower_case(word));
  }
  fuzz::require(did_you_mean(word, known).empty() == nearest.empty());
  fuzz::require(contains_ignoring_case(word + nearest, nearest));
  const std::vector<std::string> parts = split(word, '.');
  fuzz::require(word.ends_with('.') || join(parts, ".") == word);
  return 0;
}
