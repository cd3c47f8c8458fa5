#pragma once
// --math, of every command that has it.
#include "defray/device.h"
#include "options/words.h"

namespace defray::cli {

inline const WordTable<Math> math_words{{"strict", Math::strict}, {"fast", Math::fast}};

}  // namespace defray::cli
