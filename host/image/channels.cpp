#include "image/channels.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

bool is_one_of(const std::string& word, const std::set<std::string>& words) {
  return words.count(lower_case(word)) > 0;
}

std::string last_token(const std::string& layer) {
  const auto tokens = split(layer, '.');
  return tokens.empty() ? "" : tokens.back();
}

std::string first_token(const std::string& layer) { return layer.substr(0, layer.find('.')); }

/// Whole layer name, or its beginning or end at a dot; any case.
bool layer_matches(const std::string& layer, const std::string& wanted) {
  const std::string l = "." + lower_case(layer) + ".";
  const std::string w = "." + lower_case(wanted) + ".";
  return l.starts_with(w) || l.ends_with(w);
}

/// Channel index of base name `base` in this group, or -1.
int find_base(const std::vector<ChannelName>& group, const std::string& base) {
  for (const ChannelName& name : group) {
    if (lower_case(name.base) == base) return name.channel;
  }
  return -1;
}

std::vector<ChannelName> group_of(const std::vector<ChannelName>& names, const ChannelName& one) {
  std::vector<ChannelName> group;
  for (const ChannelName& name : names) {
    if (name.part == one.part && name.layer == one.layer && name.view == one.view) {
      group.push_back(name);
    }
  }
  return group;
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

/// Keeps the elements that `keep` accepts, unless it accepts none.
template <typename T, typename Keep>
void prefer(std::vector<T>& items, const Keep& keep) {
  std::vector<T> kept;
  std::copy_if(items.begin(), items.end(), std::back_inserter(kept), keep);
  if (!kept.empty()) items = std::move(kept);
}

std::string place_of(const std::string& layer, const std::string& view) {
  if (layer.empty() && view.empty()) return "no layer";
  return (layer.empty() ? "" : fmt::format("layer '{}'{}", layer, view.empty() ? "" : " ")) +
         (view.empty() ? "" : fmt::format("view '{}'", view));
}

std::string colour_listing(const std::vector<ColourChoice>& choices) {
  std::vector<std::string> lines;
  for (const ColourChoice& c : choices) lines.push_back(place_of(c.layer, c.view));
  return join(lines, ", ");
}

/// How sure a name is to be the depth of `colour`: smaller is surer, -1: it is no depth.
int depth_rank(const std::vector<ChannelName>& names, const ChannelName& name,
               const ColourChoice& colour) {
  static const std::set<std::string> depth_words{"depth", "z", "zdepth", "vrayzdepth", "pz"};
  const std::string base = lower_case(name.base);
  const std::string own_layer = last_token(name.layer);
  const std::vector<ChannelName> group = group_of(names, name);
  const bool is_vector = find_base(group, "x") >= 0 && find_base(group, "y") >= 0;
  const bool is_depth_layer = is_one_of(own_layer, depth_words);
  const bool in_colour_layer = name.layer == colour.layer;
  const bool in_same_tree = first_token(name.layer) == first_token(colour.layer) ||
                            name.layer.find('.') == std::string::npos;
  if (is_one_of(base, depth_words) && !is_vector) {
    if (in_colour_layer) return 0;
    if (is_depth_layer && in_same_tree) return 1;
    if (name.layer.empty()) return 2;
    return is_depth_layer ? 3 : 4;
  }
  // Depth rendered into a colour-like layer, as V-Ray and Arnold do: one of its equal channels.
  if (is_depth_layer && (base == "r" || base == "y" || base == "v")) return in_same_tree ? 1 : 3;
  return -1;
}

std::string depth_listing(const std::vector<ChannelName>& names,
                          const std::vector<PartInfo>& parts) {
  std::vector<std::string> lines;
  for (const ChannelName& name : names) lines.push_back(describe(name, parts));
  return join(lines, ", ");
}

std::string channel_listing(const std::vector<ChannelName>& names) {
  constexpr std::size_t shown = 24;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i) lines.push_back(names[i].full);
  if (names.size() > shown) lines.push_back(fmt::format("and {} more", names.size() - shown));
  return join(lines, " ");
}

ChannelName asked_depth(const std::string& path, const std::vector<PartInfo>& parts,
                        const std::vector<ChannelName>& names, const ChannelRequest& request,
                        const ColourChoice& colour) {
  std::vector<ChannelName> found;
  std::vector<std::string> all;
  for (const ChannelName& name : names) {
    if (name.full == request.depth_channel) found.push_back(name);
    all.push_back(name.full);
  }
  if (found.empty()) {
    fail(ErrorKind::input, "{}: has no channel '{}'.{} It has: {}", path, request.depth_channel,
         did_you_mean(request.depth_channel, all), channel_listing(names));
  }
  prefer(found, [&](const ChannelName& n) { return n.view == colour.view; });
  prefer(found, [&](const ChannelName& n) { return n.part == colour.part; });
  if (found.size() > 1) {
    fail(ErrorKind::input, "{}: several channels are called '{}': {}; choose with {}", path,
         request.depth_channel, depth_listing(found, parts), field("view"));
  }
  return found.front();
}

}  // namespace

ColourChoice choose_colour(const std::string& path, const std::vector<PartInfo>& parts,
                           const ChannelRequest& request) {
  const std::vector<ChannelName> names = channel_names(parts);
  const std::vector<ColourChoice> all = colour_candidates(names);
  if (all.empty()) {
    fail(ErrorKind::input, "{}: no colour: no layer has channels R, G and B. It has: {}", path,
         channel_listing(names));
  }
  std::vector<ColourChoice> left;
  for (const ColourChoice& c : all) {
    const bool right_view = request.view.empty() || lower_case(c.view) == lower_case(request.view);
    if (right_view && (request.layer.empty() || layer_matches(c.layer, request.layer))) {
      left.push_back(c);
    }
  }
  if (left.empty()) {
    fail(ErrorKind::input, "{}: no colour in {}; there is some in {}", path,
         place_of(request.layer, request.view), colour_listing(all));
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
  if (left.size() > 1) {
    fail(ErrorKind::input, "{}: colour could be {}; choose with {} or {}", path,
         colour_listing(left), field("layer"), field("view"));
  }
  return left.front();
}

ChannelName choose_depth(const std::string& path, const std::vector<PartInfo>& parts,
                         const ChannelRequest& request, const ColourChoice& colour) {
  const std::vector<ChannelName> names = channel_names(parts);
  if (!request.depth_channel.empty()) return asked_depth(path, parts, names, request, colour);
  if (names.size() == 1) return names.front();  // a file of nothing but depth
  std::vector<ChannelName> best;
  int best_rank = -1;
  for (const ChannelName& name : names) {
    const bool other_view = !name.view.empty() && !colour.view.empty() && name.view != colour.view;
    const int rank = depth_rank(names, name, colour);
    if (rank < 0 || other_view) continue;
    if (best.empty() || rank < best_rank) {
      best.clear();
      best_rank = rank;
    }
    if (rank == best_rank) best.push_back(name);
  }
  if (best.empty()) {
    fail(ErrorKind::input,
         "{}: no depth: no channel is called Z or depth (a Z beside X and Y is a vector). Give "
         "{} FILE or {} NAME. It has: {}",
         path, field("depth"), field("depth_channel"), channel_listing(names));
  }
  if (best.size() > 1) {
    fail(ErrorKind::input, "{}: depth could be {}; choose with {}", path,
         depth_listing(best, parts), field("depth_channel"));
  }
  return best.front();
}

}  // namespace defray
