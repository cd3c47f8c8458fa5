#pragma once
// What every part of defray throws.
#include <fmt/format.h>

#include <functional>
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

/// The name of a setting's field in a message, marked as such: what shows the message may call it
/// what its users do. The name is the member's ("squeeze"), with its structure's where it alone
/// would not tell ("aperture.image").
inline std::string field(const std::string& name) { return '\x1f' + name + '\x1f'; }

/// `text` with each field in it as `name_of` calls it.
inline std::string with_field_names(std::string text,
                                    const std::function<std::string(const std::string&)>& name_of) {
  for (auto from = text.find('\x1f'); from != std::string::npos; from = text.find('\x1f', from)) {
    const auto to = text.find('\x1f', from + 1);
    if (to == std::string::npos) break;
    const std::string name = name_of(text.substr(from + 1, to - from - 1));
    text.replace(from, to + 1 - from, name);
    from += name.size();
  }
  return text;
}

/// what() has the fields' own names: "squeeze is 9: allowed are 0.125 to 8".
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message)
      : std::runtime_error(with_field_names(message, [](const auto& name) { return name; })),
        kind_(kind),
        marked_(message) {}
  ErrorKind kind() const { return kind_; }
  /// The message with its fields still marked, for with_field_names.
  const std::string& marked() const { return marked_; }

 private:
  ErrorKind kind_;
  std::string marked_;
};

/// Throws Error(kind) with a formatted message.
template <typename... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(kind, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace defray
