#pragma once
// Throwing errors with formatted messages.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "defray/error.h"

namespace defray {

/// The name of a setting's field in a message, marked as such: what shows the message may call it
/// what its users do. The name is the member's ("squeeze"), with its structure's where it alone
/// would not tell ("aperture.image").
inline std::string field(const std::string& name) { return '\x1f' + name + '\x1f'; }

/// Throws Error(kind) with a formatted message.
template <typename... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(kind, fmt::format(format, std::forward<Args>(args)...));
}

/// Refuses a number that an enumeration from 0 to `last` has no name for, as other languages may
/// give.
template <typename Enum>
void require_named(const std::string& name, Enum value, Enum last) {
  const int number = static_cast<int>(value), most = static_cast<int>(last);
  if (number >= 0 && number <= most) return;
  fail(ErrorKind::usage, "{} is {}: allowed are 0 to {}", field(name), number, most);
}

}  // namespace defray
