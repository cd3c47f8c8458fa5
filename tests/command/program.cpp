#include "command/program.h"

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "command/forks.h"

namespace defray::test {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

std::string program() {
  const char* set = std::getenv("DEFRAY_TEST_PROGRAM");  // mutate.sh has its own
  return "'" + std::string(set ? set : DEFRAY_PROGRAM) + "'";
}

Result shell(const Folder& folder, const std::string& command) {
  const Folder logs;
  std::ofstream(logs / "command") << "cd '" << folder.path() << "' && { " << command << "; }";
  const std::string line = fmt::format("timeout -v -k 5 {} sh '{}' >'{}' 2>'{}' </dev/null",
                                       most_seconds, logs / "command", logs / "out", logs / "err");
  const int code = code_of(std::system(line.c_str()));
  return {code, text_of(logs / "out"), text_of(logs / "err")};
}

Result defray(const Folder& folder, const std::string& arguments, const std::string& prefix) {
  if (!prefix.empty()) return shell(folder, prefix + " " + program() + " " + arguments);
  const Folder logs;
  const int code = code_of(run_in_fork({folder.path(), logs / "out", logs / "err", arguments}));
  return {code, text_of(logs / "out"), text_of(logs / "err")};
}
void write_picture_file(const Folder& folder, const std::string& name,
                        const std::vector<std::string>& channels, Size size) {
  std::vector<Plane> planes;
  for (const std::string& channel : channels) {
    planes.push_back(random_plane(size, static_cast<std::uint32_t>(planes.size() + 1)));
    for (float& value : planes.back()) {
      value = channel.ends_with("Z") ? 1 + 8 * std::fmod(std::fabs(value), 1.0f)
                                     : std::fmod(std::fabs(value), 1.0f);
    }
  }
  ImageFile::from_planes(channels, planes, size.width, size.height, Sample::single_float)
      .write(folder / name);
}

void expect_refusal(const Result& result, int code, const std::vector<std::string>& words,
                    const std::string& command) {
  EXPECT_EQ(result.code, code) << command << "\n" << result.err;
  EXPECT_TRUE(result.err.rfind("defray", 0) == 0 && result.err.find(": error: ") <= 11)
      << command << "\n"
      << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << command << result.err;
  EXPECT_EQ(result.out, "") << command;
  for (const std::string& word : words) {
    EXPECT_NE(result.err.find(word), std::string::npos)
        << "'" << word << "' is not in: " << result.err << command;
  }
}

std::uint64_t file_hash(const std::string& path) {
  const ImageFile file = ImageFile::read(path);
  std::vector<Plane> planes;
  for (std::size_t p = 0; p < file.parts().size(); ++p) {
    for (std::size_t c = 0; c < file.parts()[p].channels.size(); ++c) {
      planes.push_back(file.plane(static_cast<int>(p), static_cast<int>(c)));
    }
  }
  return hash_of(planes);
}

}  // namespace defray::test
