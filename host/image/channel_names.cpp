#include "image/channel_names.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

std::set<std::string> view_names(const std::vector<PartInfo>& parts) {
  std::set<std::string> views{"left", "right"};
  for (const PartInfo& part : parts) {
    if (!part.view.empty()) views.insert(lower_case(part.view));
    for (const std::string& view : part.views) views.insert(lower_case(view));
  }
  return views;
}

/// "rgba_left" and "rgba.left" of view "left" -> "rgba".
std::string without_view(const std::string& name, const std::string& view) {
  const std::string tail = lower_case(view);
  if (view.empty() || name.size() <= tail.size() || !lower_case(name).ends_with(tail)) return name;
  const std::size_t cut = name.size() - tail.size() - 1;
  return name[cut] == '_' || name[cut] == '.' ? name.substr(0, cut) : name;
}

/// The view that a name ends in, "left" of "rgba.left"; empty: none.
std::string view_at_end(const std::string& name, const std::set<std::string>& views) {
  const std::size_t cut = name.find_last_of("._");
  const std::string last = cut == std::string::npos ? "" : name.substr(cut + 1);
  return views.count(lower_case(last)) > 0 ? last : "";
}

/// With the views of a stereo file that names them in its parts' names alone: in each.
std::vector<PartInfo> with_views(std::vector<PartInfo> parts, const std::set<std::string>& views) {
  const bool are_all_of_views =
      parts.size() > 1 && std::all_of(parts.begin(), parts.end(), [&](const PartInfo& part) {
        return part.view.empty() && !view_at_end(part.name, views).empty();
      });
  if (!are_all_of_views) return parts;
  for (PartInfo& part : parts) part.view = view_at_end(part.name, views);
  return parts;
}

ChannelName take_apart(const std::vector<PartInfo>& parts, std::size_t part, std::size_t channel,
                       const std::set<std::string>& views) {
  const PartInfo& info = parts[part];
  ChannelName name;
  name.part = static_cast<int>(part);
  name.channel = static_cast<int>(channel);
  name.full = info.channels[channel];
  name.view = info.view;
  std::vector<std::string> layer = split(name.full, '.');
  if (!layer.empty()) {
    name.base = layer.back();
    layer.pop_back();
  }
  // A token that is a view's name is not part of the layer; without one, a stereo file's channel
  // belongs to the default view (OpenEXR's multi-view convention).
  std::erase_if(layer, [&](const std::string& token) {
    if (views.count(lower_case(token)) == 0) return false;
    name.view = token;
    return true;
  });
  if (name.view.empty() && !info.views.empty()) name.view = info.views.front();
  name.layer = join(layer, ".");
  if (name.layer.empty() && parts.size() > 1) name.layer = without_view(info.name, name.view);
  return name;
}

/// Layers or lone channels of data: the whole name, or its beginning where a * follows. Lower case.
const std::vector<std::string> data_names{"n",
                                          "normal*",
                                          "p",
                                          "pref",
                                          "pworld",
                                          "pos",
                                          "position*",
                                          "z",
                                          "pz",
                                          "zdepth*",
                                          "vrayzdepth",
                                          "depth*",
                                          "denoising depth*",
                                          "denoising normal*",
                                          "vraynormals",
                                          "id",
                                          "ids",
                                          "*_id",
                                          "objectid*",
                                          "object index",
                                          "indexob",
                                          "materialid*",
                                          "material index",
                                          "indexma",
                                          "mtlid",
                                          "renderid",
                                          "nodeid",
                                          "*crypto*",
                                          "uv*",
                                          "st",
                                          "vector*",
                                          "velocity*",
                                          "vrayvelocity",
                                          "motion*"};

/// Bases that are data in whatever layer: components of vectors, depth.
const std::set<std::string> data_bases{"x", "y", "z", "u", "v", "w", "id", "depth"};

bool is_data_name(const std::string& name) {
  return std::any_of(data_names.begin(), data_names.end(), [&](const std::string& pattern) {
    return matches_glob(lower_case(name), pattern);
  });
}

}  // namespace

bool is_data_channel(const ChannelName& name) {
  const std::size_t dot = name.layer.rfind('.');
  const std::string layer = dot == std::string::npos ? name.layer : name.layer.substr(dot + 1);
  if (layer.empty()) return is_data_name(name.base);
  return is_data_name(layer) || data_bases.count(lower_case(name.base)) > 0;
}

std::string data_channel_rules() {
  std::vector<std::string> bases(data_bases.begin(), data_bases.end());
  return fmt::format("layers (or lone channels) called {}; in any layer {}; integers",
                     join(data_names, " "), join(bases, " "));
}

bool matches_glob(const std::string& name, const std::string& pattern) {
  std::size_t n = 0, p = 0, star = std::string::npos, retry = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++n, ++p;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

std::vector<ChannelName> channel_names(const std::vector<PartInfo>& all) {
  const std::set<std::string> views = view_names(all);
  const std::vector<PartInfo> parts = with_views(all, views);
  std::vector<ChannelName> names;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (std::size_t c = 0; c < parts[p].channels.size(); ++c) {
      names.push_back(take_apart(parts, p, c, views));
    }
  }
  return names;
}

std::string name_in_part(const ChannelName& name, const std::vector<PartInfo>& parts) {
  return parts[static_cast<std::size_t>(name.part)].name + "." + name.full;
}

std::string unique_name(const ChannelName& name, const std::vector<PartInfo>& parts) {
  const auto has_it = [&](const PartInfo& part) {
    return std::find(part.channels.begin(), part.channels.end(), name.full) != part.channels.end();
  };
  const bool is_unique = std::count_if(parts.begin(), parts.end(), has_it) == 1;
  return is_unique ? name.full : name_in_part(name, parts);
}

std::string describe(const ChannelName& name, const std::vector<PartInfo>& parts) {
  if (parts.size() < 2) return name.full;
  return fmt::format("{} (part {})", name.full, parts[static_cast<std::size_t>(name.part)].name);
}

}  // namespace defray
