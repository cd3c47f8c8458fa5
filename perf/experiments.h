#pragma once
// The published experiments, one file each.
#include <map>
#include <string>

#include "bench.h"

namespace defray::perf {

Section plate1(const Bench& bench);    ///< Shinya 1994, plate 1: partial occlusion.
Section plate2(const Bench& bench);    ///< Shinya 1994, plate 2 and table 1: cost.
Section figure7(const Bench& bench);   ///< Shinya 1994, figure 7: cost against cells.
Section eye(const Bench& bench);       ///< Glatzel & Wilhelm, figures 8 and 9.
Section tradeoff(const Bench& bench);  ///< Error against time, all methods.
Section truth(const Bench& bench);     ///< The RDB with its stages: gain, cost, and what is left.
Section layered(const Bench& bench);   ///< Random layers: is any other method ever closer?
Section silhouettes(const Bench& bench);   ///< False edges, where they are worst.
Section prediction(const Bench& bench);    ///< Expected errors beside true ones.
Section splat_table1(const Bench& bench);  ///< Krivanek & Zara 2003, table 1 and figure 6.
Section roofline(const Bench& bench);      ///< Kernels' times beside what the machine can do.

struct Experiment {
  std::string about;
  Section (*run)(const Bench&);
};

/// Every experiment by its name.
const std::map<std::string, Experiment>& experiments();

}  // namespace defray::perf
