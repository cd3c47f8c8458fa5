#include "image/sequence.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

constexpr std::int64_t max_frames = 1000000;
/// Frame numbers have at most nine digits; more zeros in front than this are a slip.
constexpr std::size_t max_width = 32;
constexpr int largest_frame = 999999999;

/// The folder of a path with its last slash, or nothing: patterns belong to file names only.
std::string folder_prefix(const std::string& path) {
  return path.substr(0, path.find_last_of('/') + 1);
}

/// A file name around its frame number.
struct Pattern {
  std::string before, after;
  std::size_t width = 0;  ///< Least number of characters.
  bool has_zeros = true;  ///< Filled up with zeros, else with spaces.

  std::string name(int frame) const {
    return before +
           (has_zeros ? fmt::format("{:0{}d}", frame, width)
                      : fmt::format("{:{}d}", frame, width)) +
           after;
  }
};

/// Characters of the frame pattern that begins here: a run of # and @, or %04d; 0: there is none.
std::size_t pattern_length(std::string_view text) {
  const std::size_t run = std::min(text.find_first_not_of("#@"), text.size());
  if (run > 0 || text.empty() || text[0] != '%') return run;
  const std::size_t end = text.find_first_not_of("0123456789", 1);
  return end != text.npos && text[end] == 'd' ? end + 1 : 0;
}

/// "####" and "@@" are a digit each, a single # is four; "%04d" is what printf makes of it.
Pattern pattern_of(const std::string& path, const std::string& name, std::size_t at,
                   std::size_t length) {
  Pattern pattern{name.substr(0, at), name.substr(at + length)};
  const std::string form = name.substr(at, length);
  pattern.width = form == "#" ? 4 : length;
  if (form[0] == '%') {
    pattern.has_zeros = form[1] == '0';
    pattern.width = 0;  // "%d", where nothing is read
    const auto [end, error] = std::from_chars(&form[1], &form[length - 1], pattern.width);
    if (error == std::errc::result_out_of_range) pattern.width = max_width + 1;
  }
  if (pattern.width > max_width) {
    fail(ErrorKind::usage, "{}: the frame number has too many digits; allowed are {}", path,
         max_width);
  }
  return pattern;
}

/// The pattern in a path's file name. A file that exists under its literal name is that file, and
/// an @ beside a # or a %04d is a letter, as in hero@2x.####.exr.
std::optional<Pattern> find_pattern(const std::string& path) {
  const std::string name = path.substr(folder_prefix(path).size());
  const auto is_at = [](char c) { return c == '@'; };
  std::size_t count = 0, at = 0, length = 0;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t here = pattern_length(std::string_view(name).substr(i));
    const bool wins = here > 0 && is_at(name[at]) && !is_at(name[i]);
    if (here > 0 && (count == 0 || wins || is_at(name[i]) == is_at(name[at]))) {
      if (wins) count = 0;
      if (count++ == 0) at = i, length = here;
    }
    i += std::max<std::size_t>(here, 1);
  }
  std::error_code no_file;  // a name that is too long, too
  if (count == 0 || std::filesystem::is_regular_file(path, no_file)) return std::nullopt;
  if (count > 1) {
    fail(ErrorKind::usage, "{}: has {} frame patterns; allowed is one: ####, @@ or %04d", path,
         count);
  }
  return pattern_of(path, name, at, length);
}

/// Takes a number of a frame range from the front of `text`.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || std::abs(number) > largest_frame) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

struct Range {
  int first = 0, last = 0, step = 1;
  bool is_rest = false;  ///< y: what x would leave out.

  std::int64_t span() const { return std::abs(std::int64_t{last} - first) + 1; }
  /// Frames to go over.
  std::int64_t count() const { return is_rest ? span() : (span() - 1) / step + 1; }
};

/// "7", "1-8", "1-10x2", "1-10y2"; a negative step runs from the larger end down.
std::optional<Range> parse_range(std::string_view text) {
  Range range;
  const auto first = take_number(text);
  if (!first) return std::nullopt;
  range.first = range.last = *first;
  if (text.empty()) return range;
  if (text[0] != '-') return std::nullopt;
  text.remove_prefix(1);
  const auto last = take_number(text);
  if (!last) return std::nullopt;
  range.last = *last;
  if (text.empty()) return range;
  range.is_rest = text[0] == 'y';
  if (text[0] != 'x' && !range.is_rest) return std::nullopt;
  text.remove_prefix(1);
  const auto step = take_number(text);
  if (!step || *step == 0 || !text.empty()) return std::nullopt;
  range.step = std::abs(*step);
  if (*step < 0 && range.first < range.last) std::swap(range.first, range.last);
  return range;
}

void append(const Range& range, std::vector<int>& frames) {
  const int sign = range.first <= range.last ? 1 : -1;
  for (std::int64_t i = 0; i < range.span(); i += range.is_rest ? 1 : range.step) {
    const auto frame = static_cast<int>(range.first + sign * i);
    if (!range.is_rest || i % range.step != 0) frames.push_back(frame);
  }
}

/// Keeps the first of equal frames.
void erase_repeated(std::vector<int>& frames) {
  std::vector<int> sorted = frames;
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> seen(sorted.size());
  std::erase_if(frames, [&](int frame) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), frame) - sorted.begin();
    const bool is_repeated = seen[static_cast<std::size_t>(at)];
    seen[static_cast<std::size_t>(at)] = true;
    return is_repeated;
  });
}

}  // namespace

bool has_frame_pattern(const std::string& path) { return find_pattern(path).has_value(); }

std::vector<int> parse_frames(const std::string& text) {
  std::vector<Range> ranges;
  std::int64_t count = 0;
  for (const std::string& part : split(text + ",", ',')) {
    const auto range = parse_range(part);
    if (!range) {
      fail(ErrorKind::usage,
           "{} '{}': '{}' is not a frame range; allowed: 7, 1-8, 1-10x2, 1,5,9-12, "
           "numbers up to {}",
           field("frames"), text, part, largest_frame);
    }
    count += range->count();
    ranges.push_back(*range);
  }
  if (count > max_frames) {
    fail(ErrorKind::usage, "{} '{}' goes over {} frames: allowed are at most {}", field("frames"),
         text, count, max_frames);
  }
  std::vector<int> frames;
  for (const Range& range : ranges) append(range, frames);
  if (frames.empty()) fail(ErrorKind::usage, "{} '{}' names no frame", field("frames"), text);
  erase_repeated(frames);
  return frames;
}

std::vector<int> find_frames(const std::string& pattern) {
  const std::string folder = folder_prefix(pattern);
  const std::optional<Pattern> wanted = find_pattern(pattern);
  std::vector<int> frames;
  std::string almost;
  std::error_code unreadable;
  for (const auto& entry :
       std::filesystem::directory_iterator(folder.empty() ? "." : folder, unreadable)) {
    const std::string name = entry.path().filename().string();
    if (!wanted || !name.starts_with(wanted->before)) continue;
    std::string_view rest = std::string_view(name).substr(wanted->before.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    const auto frame = take_number(rest);
    if (!frame || rest != wanted->after) continue;
    if (wanted->name(*frame) == name) {
      frames.push_back(*frame);
    } else {
      almost = name;
    }
  }
  if (frames.empty()) {
    fail(ErrorKind::input, "{}: no file matches this pattern{}", pattern,
         almost.empty() ? "" : fmt::format("; {}{} has another number of digits", folder, almost));
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

std::string gaps_between(const std::vector<int>& frames) {
  constexpr std::size_t most = 5;
  std::vector<std::string> gaps;
  bool is_even = true;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    is_even &= std::int64_t{frames[i]} - frames[i - 1] == std::int64_t{frames[1]} - frames[0];
    const int first = frames[i - 1] + 1, last = frames[i] - 1;
    if (first > last || gaps.size() > most) continue;
    gaps.push_back(gaps.size() == most ? "..."
                   : first == last     ? fmt::format("{}", first)
                                       : fmt::format("{}-{}", first, last));
  }
  return is_even ? "" : join(gaps, ", ");
}

std::string frame_path(const std::string& pattern, int frame) {
  const std::optional<Pattern> found = find_pattern(pattern);
  return found ? folder_prefix(pattern) + found->name(frame) : pattern;
}

}  // namespace defray
