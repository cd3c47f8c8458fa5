#include "splat/splat_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace defray::cli {

void print_json(const std::string& path, const Lens& lens, const CameraPose& pose,
                const SplatReport& r, double seconds) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const StageTime& s : r.stages) stages[s.stage] = s.seconds;
  const nlohmann::ordered_json line{{"output", path},
                                    {"points", r.points},
                                    {"drawn", r.drawn},
                                    {"seen", r.seen},
                                    {"from_behind", r.from_behind},
                                    {"fragments", r.fragments},
                                    {"from", pose.from},
                                    {"look_at", pose.look_at},
                                    {"focal_length_mm", lens.focal_length_mm},
                                    {"aperture_diameter_mm", lens.aperture_diameter_mm},
                                    {"sensor_width_mm", lens.sensor_width_mm},
                                    {"focus_distance_units", lens.focus_distance_units},
                                    {"nearest_units", r.nearest_units},
                                    {"farthest_units", r.farthest_units},
                                    {"nearest_coc_px", r.nearest_coc_px},
                                    {"farthest_coc_px", r.farthest_coc_px},
                                    {"stages", stages},
                                    {"tuned", r.tuned},
                                    {"seconds", seconds}};
  fmt::print("{}\n", line.dump());
}

void print_text(const std::string& path, const Lens& lens, const SplatReport& r, double seconds,
                const Device& device) {
  fmt::print("{}\n", path);
  fmt::print("  {} points drawn as {} splats, {} seen, {:.0f} fragments\n", r.points, r.drawn,
             r.seen, r.fragments);
  if (r.seen > 0) {
    fmt::print("  depth {:.6g} to {:.6g} units, CoC radius {:.4g} to {:.4g} px\n", r.nearest_units,
               r.farthest_units, r.nearest_coc_px, r.farthest_coc_px);
  }
  fmt::print("  lens {:.6g} mm, aperture {:.6g} mm, focus {:.6g} units\n", lens.focal_length_mm,
             lens.aperture_diameter_mm, lens.focus_distance_units);
  fmt::print("  {:.3f} s on {}\n", seconds, device.name());
}

}  // namespace defray::cli
