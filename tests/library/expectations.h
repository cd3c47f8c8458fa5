#pragma once
// What the program that uses the library as a user does expects of it, and how often that was not
// so.
#include <defray/defray.h>

#include <cstdio>
#include <functional>
#include <string>

inline int failures = 0;

inline void expect(bool is_true, const std::string& what) {
  if (is_true) return;
  std::fprintf(stderr, "not so: %s\n", what.c_str());
  ++failures;
}

/// `call` throws an Error of this kind, whose message has all of `part`.
inline void expect_error(defray::ErrorKind kind, const std::string& part,
                         const std::function<void()>& call) {
  try {
    call();
  } catch (const defray::Error& error) {
    const std::string message = error.what();
    expect(error.kind() == kind && message.find(part) != std::string::npos,
           "'" + message + "' says '" + part + "'");
    return;
  }
  expect(false, "an error that says '" + part + "'");
}
