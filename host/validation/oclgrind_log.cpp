#include "validation/oclgrind_log.h"

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "temporary_folder.h"

namespace defray::validation {

OclgrindLog::OclgrindLog(const DeviceInfo& info) {
  if (!is_simulator(info)) return;
  // Oclgrind opens its log once: one for the process, the user's own if there is one.
  static const TemporaryFolder folder("defray-oclgrind");
  setenv("OCLGRIND_DATA_RACES", "1", 0);
  setenv("OCLGRIND_LOG", (folder.path() + "/log").c_str(), 0);
  path_ = getenv("OCLGRIND_LOG");
  take();
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
