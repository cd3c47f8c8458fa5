// defray info: what a file holds, and the command that renders it.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/window.h"
#include "commands.h"
#include "commands/cloud_info.h"
#include "commands/suggested_command.h"
#include "defray/error.h"
#include "options/option_table.h"
#include "splat/clouds/cloud_columns.h"

namespace defray::cli {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> colour_names(const FileInfo& info) {
  std::vector<std::string> names;
  if (!info.colour) return names;
  for (const int c : info.colour->channels) {
    names.push_back(info.parts[static_cast<std::size_t>(info.colour->part)]
                        .channels[static_cast<std::size_t>(c)]);
  }
  return names;
}

void print_part(const PartInfo& part, std::size_t index) {
  fmt::print("  part {}{}: data window {}, display window {}{}\n", index,
             part.name.empty() ? "" : " '" + part.name + "'", to_string(part.data),
             to_string(part.display),
             part.integer_bits > 0 ? fmt::format(", {} bits", part.integer_bits) : "");
  for (const auto& [layer, channels] : layers_of(part)) {
    fmt::print("    {}{}\n", layer.empty() ? "" : layer + ": ", join(channels, " "));
  }
}

void print_depth(const DepthCandidate& d, const std::vector<PartInfo>& parts) {
  const std::string name = unique_name(d.channel, parts);
  if (!d.place) {
    fmt::print("  depth {}: nothing but background, {} px\n", name, d.background);
    return;
  }
  fmt::print("  depth {}: {:.6g} to {:.6g}, background {} px{}{}\n", name, d.smallest, d.largest,
             d.background, d.negative > 0 ? fmt::format(", negative {} px", d.negative) : "",
             d.is_mist ? ", a mist pass: no depth" : "");
}

/// As stored, but in the field's unit: Redshift has radians.
std::string value_of(const FoundAttribute& found) {
  const bool is_converted =
      found.value && found.attribute.factor > 0 && found.attribute.factor != 1;
  return is_converted ? fmt::format("{:.6g}", *found.value) : found.text;
}

void print_text(const FileInfo& info) {
  fmt::print("{}\n", info.path);
  for (std::size_t i = 0; i < info.parts.size(); ++i) print_part(info.parts[i], i);
  if (info.colour) {
    fmt::print("  colour {}\n", join(colour_names(info), " "));
  } else {
    const std::string why = with_field_names(info.no_colour, option_of_field);
    fmt::print("  {}\n", why.substr(why.starts_with(info.path + ": ") ? info.path.size() + 2 : 0));
  }
  if (info.unnamed_depth) {
    fmt::print("  no depth by its name: is it {0}? --depth-channel {0}, or --depth FILE\n",
               unique_name(info.unnamed_depth->channel, info.parts));
  } else if (info.depth.empty()) {
    fmt::print("  no depth: give it with --depth FILE\n");
  }
  for (const DepthCandidate& d : info.depth) print_depth(d, info.parts);
  for (const FoundAttribute& found : info.camera) {
    fmt::print("  {} {} ({}, {}){}\n", found.attribute.field, value_of(found), found.name,
               found.attribute.written,
               found.value ? "" : ", not usable: it must be a number above 0");
  }
  if (info.camera.empty()) fmt::print("  no lens among the metadata\n");
  const std::string command = suggested_command(info);
  if (!command.empty()) fmt::print("try:\n  {}\n", command);
}

Json window_json(const Window& w) { return {w.x, w.y, w.width, w.height}; }

void print_json(const FileInfo& info) {
  Json parts = Json::array(), depth = Json::array(), camera = Json::array();
  for (const PartInfo& part : info.parts) {
    parts.push_back({{"name", part.name},
                     {"view", part.view},
                     {"data_window", window_json(part.data)},
                     {"display_window", window_json(part.display)},
                     {"integer_bits", part.integer_bits},
                     {"channels", part.channels}});
  }
  for (const DepthCandidate& d : info.depth) {
    depth.push_back({{"channel", d.channel.full},
                     {"part", d.channel.part},
                     {"mist", d.is_mist},
                     {"smallest", d.smallest},
                     {"largest", d.largest},
                     {"background_px", d.background},
                     {"negative_px", d.negative}});
  }
  for (const FoundAttribute& found : info.camera) {
    camera.push_back({{"field", found.attribute.field},
                      {"attribute", found.name},
                      {"value", value_of(found)},
                      {"usable", found.value.has_value()}});
  }
  const Json line = {
      {"file", info.path},         {"parts", parts},   {"colour", colour_names(info)},
      {"depth_candidates", depth}, {"camera", camera}, {"command", suggested_command(info)}};
  // Names come from files: bytes that are no UTF-8 are replaced, not fatal.
  fmt::print("{}\n", line.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

Run add_info(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info",
                                         "What a picture or point cloud holds: parts, layers, "
                                         "windows, depths, lens; points and where they "
                                         "lie; a command that renders it");
  struct Options {
    std::string file;
    bool json = false;
  };
  auto o = std::make_shared<Options>();
  command->add_option("file", o->file, "EXR, TIFF, HDR, PNG, JPEG; PLY, text")->required();
  command->add_flag("--json", o->json, "Print one JSON object instead of text");
  command->footer("Example: defray info beauty.exr");
  return [o] {
    if (is_cloud_name(o->file)) return print_cloud_info(o->file, o->json), 0;
    const FileInfo info = describe_file(o->file);
    if (o->json) {
      print_json(info);
    } else {
      print_text(info);
    }
    return 0;
  };
}

}  // namespace defray::cli
