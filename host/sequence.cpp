#include "sequence.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <regex>

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

/// The pattern in printf form ("shot.%04d.exr"), or empty where there is none.
std::string normalized(const std::string& path) {
  std::string pattern, range;
  if (!Fs::parse_pattern(with_plain_hashes(path).c_str(), 0, pattern, range)) return "";
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

bool has_frame_pattern(const std::string& path) {
  static const std::regex form(R"([#@]|%[0-9]*d)");
  return std::regex_search(path, form) && !normalized(path).empty();
}

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
  return frames;
}

std::vector<int> find_frames(const std::string& pattern) {
  std::vector<int> frames;
  std::vector<std::string> names;
  if (!Fs::scan_for_matching_filenames(normalized(pattern), frames, names) || frames.empty()) {
    fail(ExitCode::input, "{}: no file matches this pattern", pattern);
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

std::string frame_path(const std::string& pattern, int frame) {
  const std::string form = normalized(pattern);
  if (form.empty()) return pattern;
  std::vector<std::string> names;
  Fs::enumerate_file_sequence(form, {frame}, names);
  return names.empty() ? pattern : names.front();
}

}  // namespace defray
