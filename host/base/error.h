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

}  // namespace defray
