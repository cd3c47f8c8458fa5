#include "image/channel_groups.h"

#include <fmt/format.h>

#include "base/text.h"

namespace defray {

bool is_one_of(const std::string& word, const std::set<std::string>& words) {
  return words.count(lower_case(word)) > 0;
}

std::string last_token(const std::string& layer) {
  const auto tokens = split(layer, '.');
  return tokens.empty() ? "" : tokens.back();
}

std::string first_token(const std::string& layer) { return layer.substr(0, layer.find('.')); }

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

std::string channel_listing(const std::vector<ChannelName>& names) {
  constexpr std::size_t shown = 24;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i) lines.push_back(names[i].full);
  if (names.size() > shown) lines.push_back(fmt::format("and {} more", names.size() - shown));
  return join(lines, " ");
}

}  // namespace defray
