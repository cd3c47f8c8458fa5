// What defray render prints about a frame.
#include "render/render_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "base/window.h"
#include "frame_report.h"
#include "options/option_table.h"

namespace defray::cli {
namespace {

std::string depth_line(const FrameReport& r) {
  if (r.depth_channel.empty()) return "no depth";
  if (r.depth.nearest_units == 0) {
    return fmt::format("depth {}, nothing but background", r.depth_channel);
  }
  std::string line = fmt::format("depth {}, {:.6g} to {:.6g} units", r.depth_channel,
                                 r.depth.nearest_units, r.depth.farthest_units);
  if (r.depth.background > 0) {
    line += fmt::format(", background {} px", r.depth.background);
  }
  if (r.depth.not_a_number > 0) line += fmt::format(" ({} of them NaN)", r.depth.not_a_number);
  return line;
}

std::string chain_line(const ChainReport& d) {
  std::string line = fmt::format("{} lens points, {:.2f} % of their rays determined by the input",
                                 d.lens_points, 100 * d.confidence);
  const std::pair<const char*, std::size_t> counts[] = {{"px made up behind", d.behind},
                                                        {"px split", d.split},
                                                        {"highlights", d.highlights},
                                                        {"px between rows", d.interpolated}};
  for (const auto& [name, count] : counts) {
    if (count > 0) line += fmt::format(", {} {}", count, name);
  }
  return line;
}

/// To be repeated exactly.
std::string quality_options(Quality quality, int cells_per_side) {
  return fmt::format("--quality {} --rdb {}", to_string(quality), cells_per_side);
}

std::string expected_line(const ExpectedError& e, bool is_copy) {
  const std::string chosen =
      e.quality ? quality_options(*e.quality, e.cells_per_side) + ": " : std::string();
  if (e.psnr_db >= 90) return chosen + "expected: no difference that a display would show";
  if (is_copy) {
    return fmt::format(
        "{}expected {:.1f} dB ({:.1f} to {:.1f}): a copy, as good as the pinhole picture is "
        "sampled",
        chosen, e.psnr_db, e.low_db, e.high_db);
  }
  return fmt::format(
      "{}expected {:.1f} dB ({:.1f} to {:.1f}); of the error {:.0f} % sampling, {:.0f} % hidden, "
      "{:.0f} % edges, {:.0f} % detail",
      chosen, e.psnr_db, e.low_db, e.high_db, 100 * e.shares[0], 100 * e.shares[1],
      100 * e.shares[2], 100 * e.shares[3]);
}

nlohmann::ordered_json expected_json(const ExpectedError& e) {
  nlohmann::ordered_json json = {{"psnr_srgb_db", e.psnr_db}, {"low_db", e.low_db},
                                 {"high_db", e.high_db},      {"sampling", e.shares[0]},
                                 {"hidden", e.shares[1]},     {"edges", e.shares[2]},
                                 {"detail", e.shares[3]}};
  if (e.quality) {
    json["quality"] = to_string(*e.quality);
    json["rdb"] = e.cells_per_side;
    json["misses_target"] = e.misses_target;
  }
  return json;
}

nlohmann::ordered_json chain_json(const ChainReport& d) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  nlohmann::ordered_json bytes = nlohmann::ordered_json::object();
  for (const StageTime& s : d.stages) {
    stages[s.stage] = s.seconds;
    bytes[s.stage] = s.bytes;
  }
  const TileShares& t = d.tiles;
  const nlohmann::ordered_json tiles = {{"count", t.tiles},   {"in_focus", t.in_focus},
                                        {"smooth", t.smooth}, {"mixed", t.mixed},
                                        {"hidden", t.hidden}, {"lights", t.lights}};
  return {{"lens_points", d.lens_points},
          {"confidence", d.confidence},
          {"repaired_px", d.repaired},
          {"behind_px", d.behind},
          {"split_px", d.split},
          {"highlights", d.highlights},
          {"between_px", d.interpolated},
          {"border_px", d.border_px},
          {"stages_s", stages},
          {"stages_bytes", bytes},
          {"tiles", tiles}};
}

/// The library's notes, with options for the settings in them.
std::vector<std::string> own_notes(const FrameReport& r) {
  std::vector<std::string> notes;
  for (const std::string& note : r.notes) notes.push_back(with_field_names(note, option_of_field));
  return notes;
}

/// What a tilt-shift has none of.
nlohmann::ordered_json lens_json(const FrameReport& r) {
  if (r.depth_channel.empty()) return nlohmann::ordered_json::object();
  nlohmann::ordered_json lens = {{"depth_channel", r.depth_channel},
                                 {"focal_length_mm", r.lens.focal_length_mm},
                                 {"aperture_diameter_mm", r.lens.aperture_diameter_mm},
                                 {"focus_distance_units", r.lens.focus_distance_units},
                                 {"metres_per_unit", r.lens.metres_per_unit},
                                 {"nearest_units", r.depth.nearest_units},
                                 {"farthest_units", r.depth.farthest_units},
                                 {"background_px", r.depth.background},
                                 {"nan_depth_px", r.depth.not_a_number},
                                 {"depth_outside_range_px", r.depth.outside_range}};
  if (r.lens.pixels_per_metre > 0) {
    lens["pixels_per_metre"] = r.lens.pixels_per_metre;
  } else {
    lens["sensor_width_mm"] = r.lens.sensor_width_mm;
  }
  return lens;
}

nlohmann::ordered_json report_json(const FrameReport& r) {
  nlohmann::ordered_json report = {
      {"method", to_string(r.method)},
      {"colour_channels", r.colour_channels},
      {"light_channels", r.light_channels},
      {"data_channels", r.data_channels},
      {"data_window", {r.data.x, r.data.y, r.data.width, r.data.height}},
      {"display_window", {r.display.x, r.display.y, r.display.width, r.display.height}}};
  report.update(lens_json(r));
  if (r.chain) report["chain"] = chain_json(*r.chain);
  if (r.expected) report["expected"] = expected_json(*r.expected);
  if (r.budget) {
    report["budget"] = {{"quality", to_string(r.budget->quality)},
                        {"rdb", r.budget->cells_per_side},
                        {"expected_ms", r.budget->expected_ms},
                        {"budget_ms", r.budget->budget_ms}};
  }
  report.update({{"nearest_coc_px", r.nearest_coc_px},
                 {"farthest_coc_px", r.farthest_coc_px},
                 {"coc_limited_px", r.coc_limited},
                 {"nonfinite_values", r.nonfinite},
                 {"notes", own_notes(r)},
                 {"tuned", r.tuned},
                 {"read_s", r.read_seconds},
                 {"render_s", r.render_seconds},
                 {"predict_s", r.predict_seconds},
                 {"write_s", r.write_seconds}});
  return report;
}

}  // namespace

std::vector<std::string> notes_of(const FrameReport& r) {
  std::vector<std::string> notes = own_notes(r);
  if (r.nonfinite > 0) {
    notes.push_back(fmt::format("{} NaN or Inf colour values {}", r.nonfinite,
                                r.nonfinite_kept ? "kept" : "set to 0"));
  }
  if (r.depth.outside_range > 0) {
    notes.push_back(fmt::format("{} stored depths lie outside 0...1: are they of this kind?",
                                r.depth.outside_range));
  }
  if (r.coc_limited > 0) {
    notes.push_back(fmt::format("CoC limited in {} px", r.coc_limited));
  }
  if (r.chain && r.chain->repaired > 0) {
    notes.push_back(fmt::format(
        "depth looks anti-aliased: {} px repaired (--repair off leaves them)", r.chain->repaired));
  }
  if (r.chain && r.chain->border_is_cut) {
    notes.push_back(fmt::format("the border goes on for {} px: rays from further out do not count",
                                r.chain->border_px));
  }
  return notes;
}

void print_text(const FrameOutcome& o, const std::vector<std::string>& notes,
                const std::string& device) {
  if (o.status == "skipped") {
    fmt::print("{}: exists, skipped\n", o.paths.output);
    return;
  }
  const FrameReport& r = o.report;
  fmt::print("{} -> {}\n", r.paths.input, r.paths.output);
  fmt::print("  colour {}, {}\n", join(r.colour_channels, " "), depth_line(r));
  if (!r.light_channels.empty()) fmt::print("  light {}\n", join(r.light_channels, " "));
  if (!r.data_channels.empty()) {
    fmt::print("  data of the nearest hit {}\n", join(r.data_channels, " "));
  }
  fmt::print("  data window {}, display window {}\n", to_string(r.data), to_string(r.display));
  if (!r.depth_channel.empty()) fmt::print("  lens {}\n", lens_line(r.lens));
  fmt::print("  CoC radius {:.4g} to {:.4g} px\n", r.nearest_coc_px, r.farthest_coc_px);
  if (r.chain) fmt::print("  {}\n", chain_line(*r.chain));
  if (r.budget) {
    fmt::print("  {}: {:.4g} ms expected, {:.4g} taken, of {:.4g}\n",
               quality_options(r.budget->quality, r.budget->cells_per_side), r.budget->expected_ms,
               1000 * r.render_seconds, r.budget->budget_ms);
  }
  const bool is_copy = r.nearest_coc_px == 0 && r.farthest_coc_px == 0;
  if (r.expected) fmt::print("  {}\n", expected_line(*r.expected, is_copy));
  print_notes(notes);
  fmt::print("  read {:.3f} s, {} {:.3f} s on {}, write {:.3f} s\n", r.read_seconds,
             to_string(r.method), r.render_seconds, device, r.write_seconds);
}

void print_stats(const FrameReport& r) {
  if (!r.chain) return;
  double all = 0;
  for (const StageTime& s : r.chain->stages) all += s.seconds;
  fmt::print("  {:<10} {:>8} {:>6} {:>8}\n", "stage", "ms", "share", "MiB made");
  for (const StageTime& s : r.chain->stages) {
    fmt::print("  {:<10} {:>8.1f} {:>4.0f} % {:>8.1f}\n", s.stage, 1000 * s.seconds,
               100 * s.seconds / all, std::ldexp(static_cast<double>(s.bytes), -20));
  }
  const TileShares& t = r.chain->tiles;
  fmt::print(
      "  tiles: {:.1f} % in focus, {:.1f} % smooth, {:.1f} % mixed, {:.1f} % with "
      "hidden surfaces, {:.1f} % with lights\n",
      100 * t.in_focus, 100 * t.smooth, 100 * t.mixed, 100 * t.hidden, 100 * t.lights);
  if (!r.tuned.empty()) fmt::print("  tuned: --work-group {}\n", join(r.tuned, ","));
}

void print_json_line(const FrameOutcome& o, const std::string& device) {
  nlohmann::ordered_json line;
  if (o.frame) line["frame"] = *o.frame;
  line["status"] = o.status;
  line["input"] = o.paths.input;
  line["output"] = o.paths.output;
  if (!o.error.empty()) line["error"] = o.error;
  if (o.status == "ok") {
    line["device"] = device;
    line.update(report_json(o.report));
  }
  // Names come from files: bytes that are no UTF-8 are replaced, not fatal.
  fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace defray::cli
