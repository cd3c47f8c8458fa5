// Which channel is depth.
#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "image/channel_groups.h"
#include "image/channels.h"

namespace defray {
namespace {

/// "VRayAtmospheric Effects" -> "atmosphericeffects".
std::string bare_word(const std::string& name) {
  std::string word = lower_case(name);
  std::erase_if(word, [](char c) { return c == ' ' || c == '_'; });
  return word.starts_with("vray") ? word.substr(4) : word;
}

/// "Mist.Z is a mist pass, …" for the first one there is.
std::string about_mist(const std::vector<ChannelName>& names) {
  const auto mist = std::find_if(names.begin(), names.end(), is_mist);
  if (mist == names.end()) return "";
  return fmt::format(
      " {} is a mist pass: clamped, and no distance beyond its end. Render the depth itself "
      "(Blender: View Layer, Passes, Data, Z; V-Ray: VRayZDepth without clamping; Arnold: Z)",
      mist->full);
}

bool is_of(const ColourChoice& colour, const ChannelName& name) {
  return name.part == colour.part && std::find(colour.channels.begin(), colour.channels.end(),
                                               name.channel) != colour.channels.end();
}

/// How sure a name is to be the depth of `colour`: smaller is surer, -1: it is no depth.
int depth_rank(const std::vector<ChannelName>& names, const ChannelName& name,
               const ColourChoice& colour) {
  static const std::set<std::string> depth_words{"depth", "z", "zdepth", "vrayzdepth", "pz"};
  if (is_mist(name) || is_of(colour, name)) return -1;
  if (names.size() == 1) return 0;  // nothing but depth
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
  for (const ChannelName& name : names) lines.push_back(unique_name(name, parts));
  return join(lines, ", ");
}

std::string with_stop(const std::string& text) { return text.empty() ? "" : "." + text; }

/// A grey picture that was stored as R, G and B.
std::string about_grey(const std::vector<ChannelName>& names) {
  std::vector<std::string> bases;
  for (const ChannelName& name : names) bases.push_back(name.full);
  const bool is_rgb = bases == std::vector<std::string>{"R", "G", "B"} ||
                      bases == std::vector<std::string>{"R", "G", "B", "A"};
  return is_rgb ? " (R where the depth is stored as grey)" : "";
}

ChannelName asked_depth(const std::string& path, const std::vector<PartInfo>& parts,
                        const std::vector<ChannelName>& names, const ChannelRequest& request,
                        const ColourChoice& colour) {
  std::vector<ChannelName> found;
  std::vector<std::string> all;
  for (const ChannelName& name : names) {
    if (name.full == request.depth_channel) found.push_back(name);
    all.push_back(unique_name(name, parts));
  }
  for (const ChannelName& name : names) {
    if (name_in_part(name, parts) == request.depth_channel) return name;
  }
  if (found.empty()) {
    fail(ErrorKind::input, "{}: has no channel '{}'.{} It has: {}", path, request.depth_channel,
         did_you_mean(request.depth_channel, all), channel_listing(names));
  }
  prefer(found, [&](const ChannelName& n) { return n.view == colour.view; });
  prefer(found, [&](const ChannelName& n) { return n.part == colour.part; });
  if (found.size() > 1) {
    fail(ErrorKind::input, "{}: several channels are called '{}'; choose with {}, or one of {}",
         path, request.depth_channel, field("view"), depth_listing(found, parts));
  }
  return found.front();
}

}  // namespace

bool is_mist(const ChannelName& name) {
  static const std::set<std::string> words{"mist", "fog", "atmosphere", "atmospherics",
                                           "atmosphericeffects"};
  if (words.count(bare_word(last_token(name.layer))) > 0) return true;
  // "mist pass", "AO_fog", "Mist.Z": a word of a name.
  std::string word;
  for (const char c : lower_case(last_token(name.layer) + "." + name.base) + ".") {
    if (std::isalpha(static_cast<unsigned char>(c))) {
      word += c;
    } else if (words.count(std::exchange(word, "")) > 0) {
      return true;
    }
  }
  return words.count(bare_word(name.base)) > 0;
}

ChannelName choose_depth(const std::string& path, const std::vector<PartInfo>& parts,
                         const ChannelRequest& request, const ColourChoice& colour) {
  const std::vector<ChannelName> names = channel_names(parts);
  if (!request.depth_channel.empty()) return asked_depth(path, parts, names, request, colour);
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
         "{}: no depth: no channel is called Z or depth (a Z beside X and Y is a vector). Name "
         "its file with {}, or its channel with {}{}. It has: {}{}",
         path, field("depth"), field("depth_channel"), about_grey(names), channel_listing(names),
         with_stop(about_mist(names)));
  }
  if (best.size() > 1) {
    fail(ErrorKind::input, "{}: depth could be {}; choose with {}", path,
         depth_listing(best, parts), field("depth_channel"));
  }
  return best.front();
}

std::vector<ChannelName> depth_candidates(const std::vector<PartInfo>& parts,
                                          const ColourChoice& colour) {
  const std::vector<ChannelName> names = channel_names(parts);
  std::vector<std::pair<int, ChannelName>> ranked;
  for (const ChannelName& name : names) {
    if (is_of(colour, name)) continue;
    const int rank = is_mist(name) ? 99 : depth_rank(names, name, colour);
    if (rank >= 0) ranked.emplace_back(rank, name);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ChannelName> candidates;
  for (const auto& [rank, name] : ranked) candidates.push_back(name);
  return candidates;
}

std::optional<ChannelName> only_other_channel(const std::vector<PartInfo>& parts,
                                              const ColourChoice& colour) {
  std::vector<ChannelName> others = channel_names(parts);
  std::erase_if(others, [&](const ChannelName& name) { return is_of(colour, name); });
  return others.size() == 1 ? std::optional(others.front()) : std::nullopt;
}

}  // namespace defray
