#include "splat/cloud_cache.h"

#include <OpenImageIO/hash.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "image/safe_output.h"

namespace defray {
namespace {

/// Changes with whatever changes the bytes of what follows, or how they are made.
constexpr char mark[16] = "defray surfelsC";

/// The file that the cache was made of, and what the cache holds.
struct Head {
  char mark[16];
  std::uint64_t cloud_bytes;
  std::int64_t cloud_time;
  std::uint64_t points, nodes, ridges, notes_bytes;
  double origin[3];
  std::uint32_t has_normals, has_colours;
  std::uint64_t hash;  ///< Of all that follows, and of this with a hash of 0.
};

Head head_of(const std::string& cloud) {
  Head head{};
  std::memcpy(head.mark, mark, sizeof(mark));
  std::error_code ignored;
  head.cloud_bytes = std::filesystem::file_size(cloud, ignored);
  head.cloud_time = std::filesystem::last_write_time(cloud, ignored).time_since_epoch().count();
  return head;
}

std::uint64_t hash_of(const void* bytes, std::size_t count) {
  return OIIO::xxhash::xxhash(bytes, count);
}

std::uint64_t hash_of(Head head, const Hierarchy& tree, const std::string& notes) {
  head.hash = 0;
  const std::array<std::uint64_t, 5> parts{
      hash_of(&head, sizeof(head)),
      hash_of(tree.points.data(), tree.points.size() * sizeof(DefraySplatNode)),
      hash_of(tree.nodes.data(), tree.nodes.size() * sizeof(HierarchyNode)),
      hash_of(tree.ridges.data(), tree.ridges.size() * sizeof(DefraySplatRidge)),
      hash_of(notes.data(), notes.size())};
  return hash_of(parts.data(), sizeof(parts));
}

template <typename T>
bool read_all(std::istream& file, std::vector<T>& values, std::uint64_t count) {
  values.resize(count);
  return !!file.read(reinterpret_cast<char*>(values.data()),
                     static_cast<std::streamsize>(count * sizeof(T)));
}

template <typename T>
void write_all(std::ostream& file, const std::vector<T>& values) {
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(T)));
}

/// Whoever goes through the nodes stays within them, and comes to an end.
bool is_sound(const Hierarchy& tree) {
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const HierarchyNode& n = tree.nodes[i];
    if (n.next <= i || n.next > tree.nodes.size()) return false;
    if (n.first_point > n.end_point || n.end_point > tree.points.size()) return false;
  }
  for (const DefraySplatNode& p : tree.points) {
    if (p.ridges >= tree.ridges.size() / DEFRAY_SPLAT_RIDGES) return false;
  }
  return !tree.nodes.empty() && tree.nodes.front().next == tree.nodes.size();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::string cache_path(const std::string& cloud) { return cloud + ".surfels"; }

std::optional<CachedCloud> read_cache(const std::string& cloud, std::string& why) {
  const std::string path = cache_path(cloud);
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  Head head{};
  const Head own = head_of(cloud);
  if (!file.read(reinterpret_cast<char*>(&head), sizeof(head)) ||
      std::memcmp(head.mark, own.mark, sizeof(mark)) != 0) {
    why = path + ": is no cache of this version: made anew";
    return std::nullopt;
  }
  if (head.cloud_bytes != own.cloud_bytes || head.cloud_time != own.cloud_time) {
    why = path + ": was made of an older " + cloud + ": made anew";
    return std::nullopt;
  }
  CachedCloud made{{},
                   {head.origin[0], head.origin[1], head.origin[2]},
                   head.has_normals != 0,
                   head.has_colours != 0,
                   {}};
  std::vector<char> letters;
  std::error_code ignored;
  const std::uint64_t bytes = std::filesystem::file_size(path, ignored);
  const bool fits = head.points < bytes && head.nodes < bytes && head.ridges < bytes &&
                    head.notes_bytes < bytes &&
                    bytes == sizeof(head) + head.points * sizeof(DefraySplatNode) +
                                 head.nodes * sizeof(HierarchyNode) +
                                 head.ridges * sizeof(DefraySplatRidge) + head.notes_bytes;
  if (!fits || !read_all(file, made.tree.points, head.points) ||
      !read_all(file, made.tree.nodes, head.nodes) ||
      !read_all(file, made.tree.ridges, head.ridges) ||
      !read_all(file, letters, head.notes_bytes) ||
      hash_of(head, made.tree, {letters.begin(), letters.end()}) != head.hash ||
      !is_sound(made.tree)) {
    why = path + ": is damaged: made anew";
    return std::nullopt;
  }
  made.notes = lines_of({letters.begin(), letters.end()});
  return made;
}

void write_cache(const std::string& cloud, const CachedCloud& cached) {
  Head head = head_of(cloud);
  std::string notes;
  for (const std::string& note : cached.notes) notes += note + "\n";
  head.points = cached.tree.points.size();
  head.nodes = cached.tree.nodes.size();
  head.ridges = cached.tree.ridges.size();
  head.notes_bytes = notes.size();
  std::copy(cached.origin.begin(), cached.origin.end(), head.origin);
  head.has_normals = cached.has_normals;
  head.has_colours = cached.has_colours;
  head.hash = hash_of(head, cached.tree, notes);
  write_safely(cache_path(cloud), [&](const std::string& name) {
    std::ofstream file(name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&head), sizeof(head));
    write_all(file, cached.tree.points);
    write_all(file, cached.tree.nodes);
    write_all(file, cached.tree.ridges);
    file << notes;
    file.close();
    if (!file) fail(ErrorKind::output, "{}: cannot be written: {}", name, std::strerror(errno));
  });
}

}  // namespace defray
