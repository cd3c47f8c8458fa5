#pragma once
// A folder of this process's own, among the temporary ones.
#include <string>

namespace defray {

/// Removed, with what is in it, at the end; where the process is killed first, by the next of this
/// name.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Empty where none could be made.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace defray
