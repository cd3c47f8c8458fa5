#include "frame_report.h"

#include <fmt/format.h>

namespace defray::cli {

std::string lens_line(const Lens& l) {
  return fmt::format("{:.6g} mm, aperture {:.6g} mm{}, {}, focus {:.6g} units of {:.6g} m",
                     l.focal_length_mm, l.aperture_diameter_mm,
                     l.aperture_diameter_mm > 0
                         ? fmt::format(" (f/{:.4g})", l.focal_length_mm / l.aperture_diameter_mm)
                         : "",
                     l.pixels_per_metre > 0 ? fmt::format("{:.6g} px/m", l.pixels_per_metre)
                                            : fmt::format("sensor {:.6g} mm", l.sensor_width_mm),
                     l.focus_distance_units, l.metres_per_unit);
}

std::vector<std::string> FrameNotes::take(std::vector<std::string> notes,
                                          const std::string& own_file) {
  std::erase_if(notes, [&](const std::string& note) {
    const bool is_of_file = !own_file.empty() && note.starts_with(own_file);
    return !said_.insert(is_of_file ? note.substr(own_file.size()) : note).second;
  });
  return notes;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) fmt::print("  note: {}\n", note);
}

}  // namespace defray::cli
