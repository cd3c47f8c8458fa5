#pragma once
// Channels of a layer, and the words in messages about them: what choosing colour and choosing
// depth share.
#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "image/channel_names.h"

namespace defray {

bool is_one_of(const std::string& word, const std::set<std::string>& words);
std::string first_token(const std::string& layer);
std::string last_token(const std::string& layer);

/// Channel index of base name `base` in this group, or -1.
int find_base(const std::vector<ChannelName>& group, const std::string& base);

/// All channels of the part, layer and view of `one`.
std::vector<ChannelName> group_of(const std::vector<ChannelName>& names, const ChannelName& one);

/// The first names, for a message.
std::string channel_listing(const std::vector<ChannelName>& names);

/// Keeps the elements that `keep` accepts, unless it accepts none.
template <typename T, typename Keep>
void prefer(std::vector<T>& items, const Keep& keep) {
  std::vector<T> kept;
  std::copy_if(items.begin(), items.end(), std::back_inserter(kept), keep);
  if (!kept.empty()) items = std::move(kept);
}

}  // namespace defray
