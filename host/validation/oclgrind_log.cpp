#include "validation/oclgrind_log.h"

#include <stdlib.h>

#include <algorithm>
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
  std::ofstream(path_, std::ios::trunc);  // what earlier contexts left
}

std::string OclgrindLog::take() {
  if (path_.empty()) return "";
  std::ifstream stream(path_);
  const std::string all{std::istreambuf_iterator<char>(stream), {}};
  // Oclgrind, where it still has the log open, goes on at its old place: zeros fill the gap.
  const std::size_t begin = all.find_first_not_of('\0', std::min(read_, all.size()));
  read_ = all.size();
  constexpr std::size_t longest = 600;
  return begin == std::string::npos ? "" : all.substr(begin, longest);
}

bool is_simulator(const DeviceInfo& info) { return info.platform == "Oclgrind"; }

}  // namespace defray::validation
