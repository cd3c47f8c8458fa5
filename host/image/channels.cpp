#include "image/channels.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "image/channel_groups.h"

namespace defray {
namespace {

/// Whole layer name, or its beginning or end at a dot; any case.
bool layer_matches(const std::string& layer, const std::string& wanted) {
  const std::string l = "." + lower_case(layer) + ".";
  const std::string w = "." + lower_case(wanted) + ".";
  return l.starts_with(w) || l.ends_with(w);
}

std::vector<ColourChoice> colour_candidates(const std::vector<ChannelName>& names) {
  std::vector<ColourChoice> found;
  for (const ChannelName& name : names) {
    if (lower_case(name.base) != "r" && lower_case(name.base) != "red") continue;
    const std::vector<ChannelName> group = group_of(names, name);
    const bool is_long = lower_case(name.base) == "red";
    ColourChoice choice{name.part, name.layer, name.view, {name.channel}};
    choice.channels.push_back(find_base(group, is_long ? "green" : "g"));
    choice.channels.push_back(find_base(group, is_long ? "blue" : "b"));
    if (std::count(choice.channels.begin(), choice.channels.end(), -1) > 0) continue;
    const int alpha = find_base(group, is_long ? "alpha" : "a");
    if (alpha >= 0) choice.channels.push_back(alpha);
    found.push_back(choice);
  }
  return found;
}

/// The pictures of a file that has no R, G and B: its luminances.
std::vector<ColourChoice> grey_candidates(const std::vector<ChannelName>& names) {
  std::vector<ColourChoice> found;
  for (const ChannelName& name : names) {
    if (lower_case(name.base) != "y") continue;
    const std::vector<ChannelName> group = group_of(names, name);
    ChannelName light = name;  // a layer of data, or not: a Y alone says neither
    light.base = "R";
    if (find_base(group, "x") >= 0 || is_data_channel(light)) continue;
    ColourChoice choice{name.part, name.layer, name.view, {name.channel}};
    if (const int alpha = find_base(group, "a"); alpha >= 0) choice.channels.push_back(alpha);
    found.push_back(choice);
  }
  return found;
}

std::string place_of(const std::string& layer, const std::string& view) {
  if (layer.empty() && view.empty()) return "no layer";
  return (layer.empty() ? "" : fmt::format("layer '{}'{}", layer, view.empty() ? "" : " ")) +
         (view.empty() ? "" : fmt::format("view '{}'", view));
}

std::vector<std::string> layers_of(const std::vector<ColourChoice>& choices) {
  std::vector<std::string> layers;
  for (const ColourChoice& c : choices) layers.push_back(c.layer);
  return layers;
}

std::string colour_listing(const std::vector<ColourChoice>& choices) {
  std::vector<std::string> lines;
  for (const ColourChoice& c : choices) lines.push_back(place_of(c.layer, c.view));
  return join(lines, ", ");
}

}  // namespace

std::vector<ColourChoice> all_colours(const std::vector<PartInfo>& parts) {
  const std::vector<ChannelName> names = channel_names(parts);
  const std::vector<ColourChoice> colours = colour_candidates(names);
  return colours.empty() ? grey_candidates(names) : colours;
}

ColourChoice choose_colour(const std::string& path, const std::vector<PartInfo>& parts,
                           const ChannelRequest& request) {
  const std::vector<ColourChoice> all = all_colours(parts);
  if (all.empty()) {
    fail(ErrorKind::input,
         "{}: no colour: no layer has channels R, G and B. Give a file that has them, or Y alone "
         "for grey. It has: {}",
         path, channel_listing(channel_names(parts)));
  }
  std::vector<ColourChoice> left;
  for (const ColourChoice& c : all) {
    const bool right_view = request.view.empty() || lower_case(c.view) == lower_case(request.view);
    if (right_view && (request.layer.empty() || layer_matches(c.layer, request.layer))) {
      left.push_back(c);
    }
  }
  if (left.empty()) {
    const bool is_view = request.layer.empty();
    const bool has_names = std::any_of(all.begin(), all.end(), [&](const ColourChoice& c) {
      return !(is_view ? c.view : c.layer).empty();
    });
    fail(ErrorKind::input, "{}: no colour in {}; there is some in {}.{} Leave {} out{}", path,
         place_of(request.layer, request.view), colour_listing(all),
         did_you_mean(request.layer, layers_of(all)), field(is_view ? "view" : "layer"),
         has_names ? ", or name one of these" : "");
  }
  static const std::set<std::string> beauty{"rgba", "rgb",    "beauty", "combined",
                                            "c",    "colour", "color",  "main"};
  if (request.layer.empty()) {
    prefer(left, [](const ColourChoice& c) { return c.layer.empty(); });
    prefer(left, [](const ColourChoice& c) {
      return c.layer.empty() || is_one_of(last_token(c.layer), beauty);
    });
  }
  if (request.view.empty() && !parts.front().views.empty()) {
    prefer(left, [&](const ColourChoice& c) { return c.view == parts.front().views.front(); });
  }
  const auto has_the_name = [&](const ColourChoice& c) {
    return c.layer == left.front().layer && c.view == left.front().view;
  };
  if (left.size() > 1 && std::all_of(left.begin(), left.end(), has_the_name)) {
    fail(ErrorKind::input, "{}: holds {} pictures that no name tells apart; give it a file each",
         path, left.size());
  }
  if (left.size() > 1) {
    fail(ErrorKind::input, "{}: colour could be {}; choose with {} or {}", path,
         colour_listing(left), field("layer"), field("view"));
  }
  return left.front();
}

}  // namespace defray
