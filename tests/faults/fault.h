#pragma once
// Faults to put into the kernels, one at a time: 'defray validate' must find every one. Those of a
// kernel stand beside its tests.
#include <initializer_list>
#include <vector>

#include "opencl/session.h"

namespace defray::test {

struct Fault {
  const char* kernel;  ///< Whose check must fail.
  const char* what;
  Substitution change;
  bool is_race = false;  ///< Shows on hardware by chance only: Oclgrind must find it.
};

/// Of all kernels.
inline std::vector<Fault>& all_faults() {
  static std::vector<Fault> faults;
  return faults;
}

/// Adds a file's faults to them, before main.
struct FaultRows {
  FaultRows(std::initializer_list<Fault> faults) {
    all_faults().insert(all_faults().end(), faults);
  }
};

}  // namespace defray::test
