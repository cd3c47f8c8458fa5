#include "standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "image/file_format.h"

namespace defray::cli {
namespace {

bool is_output_closed = false;

std::string read_all(int file) {
  std::string bytes;
  std::vector<char> part(1 << 16);
  ssize_t count = 0;
  while ((count = read(file, part.data(), part.size())) > 0) {
    bytes.append(part.data(), static_cast<std::size_t>(count));
  }
  return bytes;
}

bool is_pipe_without_reader(int file) {
  pollfd state{file, 0, 0};
  return poll(&state, 1, 0) == 1 && (state.revents & POLLERR) != 0;
}

}  // namespace

void open_standard_streams() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(file, F_GETFD) != -1) continue;
    if (file == STDOUT_FILENO) is_output_closed = true;
    (void)!open("/dev/null", O_RDWR);  // the lowest number that is free is this one's
  }
  std::signal(SIGPIPE, SIG_IGN);
}

bool flush_output() {
  errno = 0;
  const bool ok = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!ok && is_pipe_without_reader(STDOUT_FILENO)) std::clearerr(stdout);
  return ok;
}

bool is_output_lost() {
  flush_output();
  return std::ferror(stdout) != 0;
}

bool was_output_closed() { return is_output_closed; }

void print_error(const std::string& line) noexcept {
  std::fputs((line + "\n").c_str(), stderr);
  std::fflush(stderr);
}

PictureStreams::PictureStreams(std::string& input, std::string& output) {
  if (output == name && was_output_closed()) {
    fail(ErrorKind::output, "standard output: is closed: no picture can be written there");
  }
  if (input == name || output == name) folder_.emplace("defray-stream");
  std::string extension = ".exr";
  if (input == name) {
    const std::string bytes = read_all(STDIN_FILENO);
    const std::string found = extension_of_content(bytes);
    if (found.empty()) {
      fail(ErrorKind::input, "standard input: {}; a picture is EXR, PNG, JPEG, TIFF or HDR",
           bytes.empty() ? "is empty" : "is no picture");
    }
    copy_input(bytes, found);
    input = input_;
  }
  if (output != name) return;
  if (lower_extension(input) == ".png") extension = ".png";
  output = output_ = folder_->path() + "/standard-output" + extension;
  standard_output_ = dup(STDOUT_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
}

void PictureStreams::copy_input(const std::string& bytes, const std::string& extension) {
  input_ = folder_->path() + "/standard-input" + extension;
  errno = 0;
  std::ofstream stream(input_, std::ios::binary);
  stream << bytes;
  if (stream.flush()) return;
  fail(ErrorKind::output,
       "standard input: cannot copy its {} bytes to {}: {}; TMPDIR names another folder",
       bytes.size(), std::filesystem::temp_directory_path().string(), std::strerror(errno));
}

std::string PictureStreams::named(std::string text) const {
  for (const auto& [path, words] :
       {std::pair{input_, "standard input"}, {output_, "standard output"}}) {
    if (path.empty()) continue;
    if (text == path) return name;
    for (auto at = text.find(path); at != text.npos; at = text.find(path)) {
      text.replace(at, path.size(), words);
    }
  }
  return text;
}

void PictureStreams::finish() {
  if (output_.empty()) return;
  std::ifstream stream(output_, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(standard_output_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      fail(ErrorKind::output, "standard output: cannot write: {}", std::strerror(errno));
    }
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace defray::cli
