#pragma once
// A fault to put into a kernel.
#include "opencl/session.h"

namespace defray::test {

struct Fault {
  const char* kernel;  ///< Whose check must fail.
  const char* what;
  Substitution change;
  bool is_race = false;  ///< Shows on hardware by chance only: Oclgrind must find it.
};

}  // namespace defray::test
