#include "image/further_channels.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

bool is_colour(const ChannelName& name, const ColourChoice& colour) {
  return name.part == colour.part && std::find(colour.channels.begin(), colour.channels.end(),
                                               name.channel) != colour.channels.end();
}

bool is_alpha(const ChannelName& name) {
  return lower_case(name.base) == "a" || lower_case(name.base) == "alpha";
}

[[noreturn]] void fail_to_find(const ImageFile& file, const ColourChoice& colour,
                               const std::vector<ChannelName>& names, const std::string& pattern) {
  std::vector<std::string> there;
  for (const ChannelName& n : names) {
    if (is_colour(n, colour)) {
      if (n.full == pattern) {
        fail(ErrorKind::input, "{}: channel '{}' is colour, which goes through the lens anyway",
             file.path(), pattern);
      }
      continue;
    }
    if (n.part == colour.part && n.view == colour.view) there.push_back(n.full);
  }
  for (const ChannelName& n : names) {
    if (!matches_glob(n.full, pattern) || is_colour(n, colour)) continue;
    const auto part_name = [&](int part) {
      return file.parts()[static_cast<std::size_t>(part)].name;
    };
    if (n.part != colour.part) {
      fail(ErrorKind::input, "{}: channel '{}' is in part '{}', the colour in part '{}'",
           file.path(), n.full, part_name(n.part), part_name(colour.part));
    }
    fail(ErrorKind::input, "{}: channel '{}' is of view '{}', the colour of view '{}'", file.path(),
         n.full, n.view, colour.view);
  }
  fail(ErrorKind::input, "{}: has no channel '{}' beside its colour.{} {}", file.path(), pattern,
       did_you_mean(pattern, there),
       there.empty() ? "It has no other" : "It has: " + join(there, " "));
}

/// Channels of a layer in fours: colour and alpha together, so that each layer is taken apart at
/// edges as a whole.
std::vector<LightGroup> in_groups(const std::vector<ChannelName>& light) {
  std::vector<std::string> layers;
  for (const ChannelName& n : light) {
    if (std::find(layers.begin(), layers.end(), n.layer) == layers.end()) layers.push_back(n.layer);
  }
  std::vector<LightGroup> groups;
  for (const std::string& layer : layers) {
    std::vector<ChannelName> members;
    for (const ChannelName& n : light) {
      if (n.layer == layer) members.push_back(n);
    }
    std::stable_partition(members.begin(), members.end(),
                          [](const ChannelName& n) { return !is_alpha(n); });
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i % 4 == 0) groups.emplace_back();
      groups.back().channels.push_back(members[i].channel);
      groups.back().has_alpha = is_alpha(members[i]) && groups.back().channels.size() > 1;
    }
  }
  return groups;
}

}  // namespace

std::vector<std::string> parse_channel_list(const std::string& list) {
  const std::vector<std::string> patterns = split(list + ",", ',');  // "" is one empty name
  for (const std::string& pattern : patterns) {
    if (pattern.empty())
      fail(ErrorKind::usage, "{} '{}': a name in it is empty", field("channels"), list);
  }
  return patterns;
}

FurtherChannels choose_further(const ImageFile& file, const ColourChoice& colour,
                               const std::vector<std::string>& patterns) {
  const std::vector<ChannelName> names = channel_names(file.parts());
  std::set<int> chosen;
  for (const std::string& pattern : patterns) {
    bool is_found = false;
    for (const ChannelName& n : names) {
      if (n.part != colour.part || n.view != colour.view || is_colour(n, colour)) continue;
      if (!matches_glob(n.full, pattern)) continue;
      chosen.insert(n.channel);
      is_found = true;
    }
    if (!is_found) fail_to_find(file, colour, names, pattern);
  }
  FurtherChannels further;
  std::vector<ChannelName> light;
  for (const ChannelName& n : names) {
    if (n.part != colour.part || chosen.count(n.channel) == 0) continue;
    if (is_data_channel(n) || file.holds_integers(n.part, n.channel)) {
      further.data.push_back(n.channel);
    } else {
      light.push_back(n);
    }
  }
  further.light = in_groups(light);
  return further;
}

}  // namespace defray
