#pragma once
// What reports of a frame have in common, whatever it was made of.
#include <set>
#include <string>
#include <vector>

#include "defray/lens.h"

namespace defray::cli {

/// "50 mm, aperture 25 mm (f/2), sensor 36 mm, focus 3 units of 1 m".
std::string lens_line(const Lens& lens);

/// Notes on the frames of a run, of which each is said once.
class FrameNotes {
 public:
  /// Those that were not taken before. A frame's file, where it has one of its own, counts as that
  /// of all frames.
  std::vector<std::string> take(std::vector<std::string> notes, const std::string& own_file = "");

 private:
  std::set<std::string> said_;
};

/// A line each, for people.
void print_notes(const std::vector<std::string>& notes);

}  // namespace defray::cli
