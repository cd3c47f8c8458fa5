#pragma once
// What every part of defray throws. The CLI prints it once, at the top, and exits with its code.
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace defray {

/// Exit codes of the program; the README documents them.
enum class ExitCode : int {
  ok = 0,
  failed = 1,  ///< Some frames of a sequence failed, or a comparison missed its bound.
  usage = 2,   ///< An option, or a combination of options, that makes no sense.
  input = 3,   ///< An input that is missing, unreadable, or not what was asked for.
  output = 4,  ///< An output that cannot be written.
  device = 5,  ///< No OpenCL device, or an OpenCL call that failed.
  internal = 70,
};

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Throws Error(code) with a formatted message.
template <typename... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace defray
