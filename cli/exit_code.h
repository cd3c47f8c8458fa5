#pragma once
// What the program says to a shell.
#include "defray/error.h"

namespace defray::cli {

/// Exit codes; the README documents them.
enum ExitCode : int {
  ok = 0,
  failed = 1,  ///< Some frames of a sequence failed, a kernel did, a comparison missed its bound.
  wrong_usage = 2,
  bad_input = 3,
  no_output = 4,
  device_failed = 5,
  bug = 70,
};

constexpr ExitCode exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return wrong_usage;
    case ErrorKind::input:
      return bad_input;
    case ErrorKind::output:
      return no_output;
    case ErrorKind::device:
      return device_failed;
    case ErrorKind::internal:
      break;
  }
  return bug;
}

}  // namespace defray::cli
