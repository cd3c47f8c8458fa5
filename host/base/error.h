#pragma once
// What every part of defray throws.
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace defray {

/// What went wrong. What follows from it (the program's exit code) is for who catches it to say.
enum class ErrorKind {
  usage,   ///< A setting, or a combination of settings, that makes no sense.
  input,   ///< An input that is missing, unreadable, or not what was asked for.
  output,  ///< An output that cannot be written.
  device,  ///< No OpenCL device, or an OpenCL call that failed.
  internal,
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// Throws Error(kind) with a formatted message.
template <typename... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(kind, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace defray
