#include "validation/oclgrind_log.h"

#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "opencl/device.h"

namespace defray::validation {

OclgrindLog::OclgrindLog(const DeviceInfo& info) {
  if (!is_simulator(info)) return;
  // In memory: nothing is left behind whatever ends the process. One for all contexts of a process.
  static const int file = memfd_create("oclgrind", 0);
  if (file < 0 || ftruncate(file, 0) != 0) return;
  file_ = file;
  setenv("OCLGRIND_DATA_RACES", "1", 0);
  setenv("OCLGRIND_MAX_ERRORS", "1000000000", 0);  // silent after 1000: other kernels would pass
  setenv("OCLGRIND_LOG", ("/proc/self/fd/" + std::to_string(file)).c_str(), 1);
}

std::string OclgrindLog::take() {
  if (file_ < 0) return "";
  const off_t end = lseek(file_, 0, SEEK_END);
  std::string news(static_cast<std::size_t>(std::max<off_t>(end - read_, 0)), '\0');
  const ssize_t got = pread(file_, news.data(), news.size(), read_);
  read_ = end;
  news.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  // Oclgrind, where it still has the log open, goes on at its old place: zeros fill the gap.
  constexpr std::size_t longest = 600;
  const std::size_t begin = news.find_first_not_of('\0');
  return begin == std::string::npos ? "" : news.substr(begin, longest);
}

bool is_simulator(const DeviceInfo& info) { return info.platform == "Oclgrind"; }

}  // namespace defray::validation
