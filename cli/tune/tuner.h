#pragma once
// defray tune at work: tries work-groups, a shape of every kernel in each picture.
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tune/workload.h"
#include "tuning/tuning_file.h"

namespace defray::cli {

/// Gets seconds that went by, and the best that was found in this workload so far: "fill 16x1, 12 %
/// sooner"; empty: nothing yet.
using TuneProgress = std::function<void(double seconds, const std::string& best)>;

class Tuner {
 public:
  /// `kernels`: tuned however little time they take; empty: those that take 2 % or more of what all
  /// kernels of a picture take. Results go to the file as they come. The device must be opened with
  /// DeviceOptions::measures, and without use_tuning.
  Tuner(Device& device, std::string path, std::vector<std::string> kernels);

  /// So long, one picture at the least, or until nothing is left to learn. Throws Error(device)
  /// where the launch table's own work-groups do not give the twins' bits, or none of `kernels`
  /// runs; Error(output).
  void run(const Workload& workload, double seconds, const TuneProgress& progress);

  /// Kernels that were tuned in any picture.
  const std::set<std::string>& tuned() const { return tuned_; }

  /// What the file knows.
  const std::vector<tuning::Result>& results() const { return results_; }

 private:
  using Shapes = std::map<std::string, tuning::Shape>;
  using Milliseconds = std::map<std::string, double>;
  /// Kernels' times in a picture with these work-groups; none where it has other bits. Throws
  /// Error(device) where the device does not run it.
  Milliseconds draw(const Shapes& shapes);
  /// What came of it; where it went wrong, of each alone.
  std::vector<tuning::Result> tries(const Shapes& shapes);
  Milliseconds start(const Workload& workload);
  tuning::Place place_of(const std::string& kernel) const {
    return {workload_->frame_class, workload_->about, kernel};
  }
  Shapes next_shapes(const std::vector<std::string>& kernels, bool explores) const;
  bool is_done(const std::vector<std::string>& kernels) const;
  std::string best_so_far() const;
  void set(const Shapes& shapes);
  void keep(const std::vector<tuning::Result>& results);

  Device& device_;
  std::string path_;
  tuning::Key key_;
  std::vector<std::string> kernels_;
  std::vector<tuning::Result> results_;
  std::set<std::string> tuned_;
  std::set<std::pair<std::string, tuning::Shape>> compiled_;  ///< In this process.
  const Workload* workload_ = nullptr;
  Drawn expected_, expected_small_;
};

}  // namespace defray::cli
