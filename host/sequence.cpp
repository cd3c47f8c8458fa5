#include "sequence.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "error.h"

namespace defray {
namespace {

namespace Fs = OIIO::Filesystem;

constexpr std::size_t max_frames = 1000000;

/// OpenImageIO pads "#" to four digits and "####" to sixteen; everybody else means four by "####".
/// Two or more become as many "@", which OpenImageIO takes for one digit each.
std::string with_plain_hashes(std::string path) {
  for (std::size_t at = path.find("##"); at != std::string::npos; at = path.find("##", at)) {
    while (at < path.size() && path[at] == '#') path[at++] = '@';
  }
  return path;
}

/// The folder of a path with its last slash, or nothing: patterns belong to file names only.
std::string folder_of(const std::string& path) {
  return path.substr(0, path.find_last_of('/') + 1);
}

/// The file name's pattern in printf form ("shot.%04d.exr"), or empty where there is none. A file
/// that exists under its literal name is that file.
std::string name_pattern(const std::string& path) {
  const std::string name = path.substr(folder_of(path).size());
  static const std::regex form(R"([#@]+|%[0-9]*d)");
  const auto count = std::distance(std::sregex_iterator(name.begin(), name.end(), form), {});
  if (count == 0 || std::filesystem::is_regular_file(path)) return "";
  if (count > 1) {
    fail(ExitCode::usage, "{}: has {} frame patterns; allowed is one: ####, @@ or %04d", path,
         count);
  }
  std::string pattern, range;
  if (!Fs::parse_pattern(with_plain_hashes(name).c_str(), 0, pattern, range)) return "";
  return pattern;
}

/// Frames a range stands for, before OpenImageIO makes a list of them.
double frames_in(const std::string& part) {
  static const std::regex form(R"((-?\d{1,9})-(-?\d{1,9})(?:[xy](-?\d{1,9}))?)");
  std::smatch match;
  if (!std::regex_match(part, match, form)) return 1;
  return std::abs(std::stod(match[2]) - std::stod(match[1])) + 1;
}

}  // namespace

bool has_frame_pattern(const std::string& path) { return !name_pattern(path).empty(); }

std::vector<int> parse_frames(const std::string& text) {
  static const std::regex item(R"(-?\d{1,9}(-(-?\d{1,9})([xy]-?[1-9]\d{0,8})?)?)");
  double count = 0;
  std::string rest = text + ",";
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string part = rest.substr(0, comma);
    rest.erase(0, comma + 1);
    if (!std::regex_match(part, item)) {
      fail(ExitCode::usage,
           "--frames '{}': '{}' is not a frame range; allowed: 7, 1-8, 1-10x2, 1,5,9-12", text,
           part);
    }
    count += frames_in(part);
  }
  if (count > static_cast<double>(max_frames)) {
    fail(ExitCode::usage, "--frames '{}' are {} frames: allowed are at most {}", text, count,
         max_frames);
  }
  std::vector<int> frames;
  if (!Fs::enumerate_sequence(text, frames) || frames.empty()) {
    fail(ExitCode::usage, "--frames '{}' names no frame", text);
  }
  std::set<int> seen;
  std::erase_if(frames, [&](int frame) { return !seen.insert(frame).second; });
  return frames;
}

std::vector<int> find_frames(const std::string& pattern) {
  const std::string folder = folder_of(pattern);
  std::vector<int> frames;
  std::error_code unreadable;
  for (const auto& entry :
       std::filesystem::directory_iterator(folder.empty() ? "." : folder, unreadable)) {
    static const std::regex digits(R"(-?\d{1,9})");
    const std::string name = entry.path().filename().string();
    // Any number in the name could be the frame: the one that gives back this name is.
    for (std::sregex_iterator i(name.begin(), name.end(), digits), end; i != end; ++i) {
      const int frame = std::stoi(i->str());
      if (frame_path(pattern, frame) == folder + name) frames.push_back(frame);
    }
  }
  if (frames.empty()) fail(ExitCode::input, "{}: no file matches this pattern", pattern);
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

std::string frame_path(const std::string& pattern, int frame) {
  const std::string form = name_pattern(pattern);
  if (form.empty()) return pattern;
  std::vector<std::string> names;
  Fs::enumerate_file_sequence(form, {frame}, names);
  return folder_of(pattern) + (names.empty() ? form : names.front());
}

}  // namespace defray
