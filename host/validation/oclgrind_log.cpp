#include "validation/oclgrind_log.h"

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace defray::validation {

OclgrindLog::OclgrindLog(const DeviceInfo& info) {
  if (!is_simulator(info)) return;
  setenv("OCLGRIND_DATA_RACES", "1", 0);
  if (const char* own = getenv("OCLGRIND_LOG")) {
    path_ = own;
    return;
  }
  folder_ = std::make_unique<TemporaryFolder>("defray-oclgrind");
  path_ = folder_->path() + "/log";
  setenv("OCLGRIND_LOG", path_.c_str(), 1);
}

OclgrindLog::~OclgrindLog() {
  if (folder_) unsetenv("OCLGRIND_LOG");
}

std::string OclgrindLog::take() {
  if (path_.empty()) return "";
  std::ifstream stream(path_);
  const std::string all{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::size_t longest = 600;
  const std::string news = all.substr(std::min(read_, all.size()), longest);
  read_ = all.size();
  return news;
}

bool is_simulator(const DeviceInfo& info) { return info.platform == "Oclgrind"; }

}  // namespace defray::validation
