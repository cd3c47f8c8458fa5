#include "validation/oclgrind_log.h"

#include <stdlib.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "temporary_folder.h"

namespace defray::validation {

OclgrindLog::OclgrindLog(const DeviceInfo& info) {
  if (!is_simulator(info)) return;
  // One for the process; the user's own if there is one.
  static const TemporaryFolder folder("defray-oclgrind");
  setenv("OCLGRIND_DATA_RACES", "1", 0);
  setenv("OCLGRIND_LOG", (folder.path() + "/log").c_str(), 0);
  path_ = getenv("OCLGRIND_LOG");
  std::remove(path_.c_str());  // a new context would begin it anew
}

std::string OclgrindLog::take() {
  if (path_.empty()) return "";
  std::ifstream stream(path_);
  const std::string all{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::size_t longest = 600;
  const bool is_longer = all.compare(0, seen_.size(), seen_) == 0;
  const std::string news = all.substr(is_longer ? seen_.size() : 0, longest);
  seen_ = all;
  return news;
}

bool is_simulator(const DeviceInfo& info) { return info.platform == "Oclgrind"; }

}  // namespace defray::validation
