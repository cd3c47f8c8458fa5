#pragma once
// What every part of defray throws.
#include <functional>
#include <stdexcept>
#include <string>

#include "defray/export.h"

namespace defray {

/// What went wrong. What follows from it (the program's exit code) is for who catches it to say.
enum class ErrorKind {
  usage,   ///< A setting, or a combination of settings, that makes no sense.
  input,   ///< An input that is missing, unreadable, or not what was asked for.
  output,  ///< An output that cannot be written.
  device,  ///< No OpenCL device, or an OpenCL call that failed.
  internal,
};

/// `text` with each field in it (marked by \x1f on both sides) as `name_of` calls it.
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

/// what() is one clear line that has the settings' names as their structures do: "squeeze is 9:
/// allowed are 0.125 to 8".
class DEFRAY_API Error : public std::runtime_error {
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

}  // namespace defray
