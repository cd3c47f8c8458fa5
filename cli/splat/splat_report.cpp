#include "splat/splat_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "frame_report.h"

namespace defray::cli {

namespace {

/// Names come from files: bytes that are no UTF-8 are replaced, not fatal.
void print_line(const nlohmann::ordered_json& line) {
  fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

void print_skipped(const SplatCommand& job, const SplatShot& shot) {
  if (job.json) {
    nlohmann::ordered_json line;
    if (shot.frame) line["frame"] = *shot.frame;
    line.update({{"status", "skipped"}, {"output", shot.output}});
    print_line(line);
  } else if (!job.quiet) {
    fmt::print("{}: exists, skipped\n", shot.output);
  }
}

void print_json(const SplatShot& shot, const SplatOutcome& outcome) {
  const SplatReport& r = outcome.report;
  const Lens& lens = outcome.camera.lens;
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const StageTime& s : r.stages) stages[s.stage] = s.seconds;
  nlohmann::ordered_json line;
  if (shot.frame) line["frame"] = *shot.frame;
  line.update({{"status", "ok"},
               {"input", outcome.input},
               {"output", shot.output},
               {"device", outcome.device},
               {"points", r.points},
               {"drawn", r.drawn},
               {"seen", r.seen},
               {"both_sides", r.both_sides},
               {"from_behind", r.from_behind},
               {"is_inside_out", r.is_inside_out},
               {"fragments", std::llround(r.fragments)},
               {"spilled", r.spilled},
               {"from", outcome.camera.pose.from},
               {"look_at", outcome.camera.pose.look_at},
               {"focal_length_mm", lens.focal_length_mm},
               {"aperture_diameter_mm", lens.aperture_diameter_mm},
               {"sensor_width_mm", lens.sensor_width_mm},
               {"focus_distance_units", lens.focus_distance_units},
               {"nearest_units", r.nearest_units},
               {"farthest_units", r.farthest_units},
               {"nearest_coc_px", r.nearest_coc_px},
               {"farthest_coc_px", r.farthest_coc_px},
               {"stages_s", stages},
               {"notes", outcome.notes},
               {"tuned", r.tuned},
               {"ready_s", outcome.ready_seconds},
               {"render_s", outcome.render_seconds}});
  print_line(line);
}

void print_text(const SplatShot& shot, const SplatOutcome& outcome,
                const std::vector<std::string>& notes) {
  const SplatReport& r = outcome.report;
  fmt::print("{}\n", shot.output);
  fmt::print("  {} points drawn as {} splats, {} seen, {:.0f} fragments\n", r.points, r.drawn,
             r.seen, r.fragments);
  if (r.seen > 0) {
    fmt::print("  depth {:.6g} to {:.6g} units, CoC radius {:.4g} to {:.4g} px\n", r.nearest_units,
               r.farthest_units, r.nearest_coc_px, r.farthest_coc_px);
  }
  fmt::print("  lens {}\n", lens_line(outcome.camera.lens));
  print_notes(notes);
  fmt::print("  {:.3f} s on {}{}\n", outcome.render_seconds, outcome.device,
             outcome.ready_seconds > 0
                 ? fmt::format(", after {:.3f} s to make the cloud ready", outcome.ready_seconds)
                 : "");
}

}  // namespace defray::cli
