#pragma once
// What the fuzzers share: bytes to take apart, and what a parser may do with them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"

namespace defray::fuzz {

/// Aborts, so that libFuzzer keeps the bytes that led here.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Runs a parser: it returns, or throws Error(usage) or Error(input) with a message. Anything else
/// ends the fuzzer.
template <typename Call>
void run_parser(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::usage || error.kind() == ErrorKind::input);
    require(error.what()[0] != '\0');
  }
}

/// The bytes of one run, taken from the front.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : text_(data, data + size) {}

  /// 0 when nothing is left.
  unsigned next() { return at_ < text_.size() ? static_cast<unsigned char>(text_[at_++]) : 0u; }

  /// Everything up to a line's end, or the end; without zeros, which no argument can hold.
  std::string line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string line = text_.substr(at_, end - at_);
    std::erase(line, '\0');
    at_ = std::min(end + 1, text_.size());
    return line;
  }

  std::string rest() {
    const std::string rest = text_.substr(at_);
    at_ = text_.size();
    return rest;
  }

  bool is_empty() const { return at_ == text_.size(); }

 private:
  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace defray::fuzz
