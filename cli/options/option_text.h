#pragma once
// What messages say of an option.
#include <string>

namespace defray::cli {

struct OptionText {
  std::string name;  ///< "--focal-length".
  std::string help;  ///< What it takes, in which unit: "mm".
};

}  // namespace defray::cli
