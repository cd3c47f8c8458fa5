#include "image/safe_output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <set>

#include "base/error.h"
#include "base/process.h"

namespace defray {
namespace {

namespace fs = std::filesystem;

/// A temporary file in hand, for a signal handler.
struct Place {
  std::atomic<bool> is_taken = false;
  std::atomic<bool> is_named = false;  ///< The path is complete.
  std::array<char, 4096> path{};
};
/// Of as many threads as write at a time; what more of them leave behind the next run removes.
std::array<Place, 16> places{};

Place* free_place() {
  for (Place& place : places) {
    if (!place.is_taken.exchange(true)) return &place;
  }
  return nullptr;
}

/// Registers a temporary file for the time it exists; removes it when it was not renamed.
class Temporary {
 public:
  explicit Temporary(const std::string& path) : path_(path), place_(free_place()) {
    if (!place_ || path.size() >= place_->path.size()) return;
    std::memcpy(place_->path.data(), path.c_str(), path.size() + 1);
    place_->is_named = true;
  }
  ~Temporary() {
    unlink(path_.c_str());  // fails harmlessly after the rename
    if (!place_) return;
    place_->is_named = false;
    place_->is_taken = false;
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

 private:
  std::string path_;
  Place* place_;
};

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// This machine, in a temporary file's name: on a shared disk others have processes of their own.
std::string host_mark() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return fmt::format("{:08x}", std::hash<std::string>()(name.data()) & 0xffffffff);
}

/// Hidden, beside the target, unique to this process, with the same extension: image libraries
/// choose the format by it. What only asks has names of its own: another thread may be writing.
std::string temporary_name(const std::string& path, char mark = '-') {
  const fs::path target(path);
  const std::string end =
      fmt::format(".defray{}{}-{}{}", mark, host_mark(), getpid(), target.extension().string());
  std::string stem = target.stem().string();
  const bool is_allowed = target.filename().native().size() <= NAME_MAX;
  if (is_allowed && stem.size() + end.size() >= NAME_MAX) {  // cut, and still another for each
    const std::string whole = fmt::format("{:08x}", std::hash<std::string>()(stem) & 0xffffffff);
    stem.resize(NAME_MAX - 1 - std::min<std::size_t>(NAME_MAX - 1, end.size() + whole.size()));
    stem += whole;
  }
  return (folder_of(path) / ("." + stem + end)).string();
}

/// Of a name that temporary_name made on this machine, the process; 0 for any other.
long process_of(const std::string& name) {
  const std::string maker = ".defray", mark = host_mark() + "-";
  const std::size_t at = name.rfind(mark);
  const std::size_t begin = name.rfind(maker, at);
  const bool is_ours = name[0] == '.' && at != name.npos && begin != name.npos && begin > 0 &&
                       begin + maker.size() + 1 == at;
  return is_ours ? std::strtol(name.c_str() + at + mark.size(), nullptr, 10) : 0;
}

/// Temporary files of processes that were killed, once a folder.
void remove_stale_files(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<std::string> seen;
  const std::lock_guard lock(mutex);
  std::error_code ignored;
  if (!seen.insert(fs::absolute(folder, ignored).string()).second) return;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const long process = process_of(entry.path().filename().string());
    if (process > 0 && !is_running(process)) fs::remove(entry.path(), ignored);
  }
}

/// ": No space left on device", where that is why and the library that wrote did not say so.
std::string why_not_written(const std::string& path, const std::string& message) {
  constexpr std::uintmax_t nothing = 64 << 10;  // less than what a writer may still want
  const std::string full = std::strerror(ENOSPC);
  std::error_code unknown;
  const fs::space_info space = fs::space(folder_of(path), unknown);
  const bool is_full = !unknown && space.available < nothing;
  return is_full && message.find(full) == message.npos ? ": " + full : "";
}

void sync_path(const std::string& what, const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY);
  const bool ok = file >= 0 && fsync(file) == 0;
  const int code = errno;
  if (file >= 0) close(file);
  if (!ok) fail(ErrorKind::output, "{}: cannot sync it to disk: {}", what, std::strerror(code));
}

/// As far as that goes: who may write into a folder need not be let read it, and some file systems
/// sync none. The file is there, and synced.
void sync_folder(const std::string& path) {
  const int folder = open(path.c_str(), O_RDONLY);
  if (folder < 0) return;
  (void)fsync(folder);
  close(folder);
}

/// Who may read and write a file stays so when another takes its place.
void keep_permissions(const std::string& before, const std::string& after) {
  std::error_code is_new;
  const fs::file_status status = fs::status(before, is_new);
  if (fs::is_regular_file(status)) fs::permissions(after, status.permissions(), is_new);
}

/// The file that a name stands for, there or not yet: renaming over a link would leave what it
/// names stale.
std::string behind_links(const std::string& path) {
  constexpr int most = 40;  // as the system has it
  fs::path at = path;
  std::error_code none;
  for (int i = 0; i < most && fs::is_symlink(at, none); ++i) {
    at = at.parent_path() / fs::read_symlink(at, none);
  }
  return at.string();
}

/// Renaming puts a file in the place of anything: pipes and devices, too.
void refuse_device(const std::string& path) {
  std::error_code names_nothing;  // what is wrong with it then, opening tells
  if (!fs::exists(path, names_nothing) || fs::is_directory(path, names_nothing) ||
      fs::is_regular_file(path, names_nothing)) {
    return;
  }
  fail(ErrorKind::output, "{}: is a pipe or a device, and would be replaced; name a file", path);
}

/// Renaming needs no more than a folder that may be written in: the file itself is to be asked,
/// too. Root may write any, but who took the right from all means it.
void refuse_protected(const std::string& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0 || !S_ISREG(about.st_mode)) return;
  const bool nobody_may = (about.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0;
  if (!nobody_may && (access(path.c_str(), W_OK) == 0 || errno == EROFS)) return;
  fail(ErrorKind::output,
       "{}: is write-protected; allow writing it (chmod u+w) or name another file", path);
}

}  // namespace

void create_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    fail(ErrorKind::output, "{}: cannot create this folder: {}", path, error.message());
  }
}

void check_can_write(const std::string& to, const std::string& hint) {
  std::error_code names_nothing;  // what is wrong with it then, opening tells
  if (fs::is_directory(to, names_nothing)) {
    fail(ErrorKind::output, "{}: is a folder, not a file name", to);
  }
  refuse_device(to);
  refuse_protected(to);
  const std::string path = behind_links(to);
  remove_stale_files(folder_of(path));
  const std::string probe = temporary_name(path, '+');
  const int file = open(probe.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0666);
  if (file < 0) {
    const int code = errno;
    fail(ErrorKind::output, "{}: cannot write in folder {}: {}{}", path, folder_of(path).string(),
         std::strerror(code), code == ENOENT && !hint.empty() ? "; " + hint : "");
  }
  close(file);
  unlink(probe.c_str());
}

void check_can_make(const std::string& path) {
  std::error_code names_nothing;
  fs::path there = folder_of(path);
  while (!fs::exists(there, names_nothing) && there != folder_of(there)) there = folder_of(there);
  if (!fs::is_directory(there, names_nothing)) {
    fail(ErrorKind::output, "{}: cannot create this folder: {}", folder_of(path).string(),
         std::strerror(ENOTDIR));
  }
  check_can_write((there / fs::path(path).filename()).string());
}

void write_safely(const std::string& to, const std::function<void(const std::string&)>& write) {
  refuse_device(to);
  refuse_protected(to);
  const std::string path = behind_links(to);
  const std::string name = temporary_name(path);
  const Temporary temporary(name);
  try {
    write(name);
  } catch (const Error& error) {  // the user knows the output by its own name
    std::string message = error.marked();
    for (auto at = message.find(name); at != std::string::npos; at = message.find(name)) {
      message.replace(at, name.size(), path);
    }
    throw Error(error.kind(), message + why_not_written(path, message));
  }
  keep_permissions(path, name);
  sync_path(path, name);
  if (std::rename(name.c_str(), path.c_str()) != 0) {
    fail(ErrorKind::output, "{}: cannot rename the finished file to it: {}", path,
         std::strerror(errno));
  }
  sync_folder(folder_of(path).string());
}

void write_text(const std::string& path, const std::string& text) {
  write_safely(path, [&](const std::string& name) {
    std::ofstream stream(name);
    stream << text;
    if (!stream.flush()) fail(ErrorKind::output, "{}: cannot write", name);
  });
}

void remove_temporary() {
  for (const Place& place : places) {
    if (place.is_named) unlink(place.path.data());
  }
}

bool is_written(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_regular_file(status)) return fs::file_size(path, ignored) > 0;
  return fs::exists(status) && !fs::is_directory(status);
}

bool is_same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  const auto place = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  return place(a) == place(b) || std::filesystem::equivalent(a, b, error);
}

}  // namespace defray
