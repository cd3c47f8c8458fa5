#pragma once
// Work-groups that `defray tune` has tried on a device, and what follows from them.
#include <compare>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace defray::tuning {

/// A work-group; any gives the same bits.
struct Shape {
  std::size_t x = 0, y = 0;
  auto operator<=>(const Shape&) const = default;
};

/// "8x4".
std::string to_string(const Shape& shape);

/// What came of a try.
enum class Validity {
  correct,      ///< The twins' bits.
  correctness,  ///< Others: it counts for nothing.
  runtime,      ///< The device did not run it.
};

/// Where a kernel was tried: times are compared within one picture.
struct Place {
  std::string frame_class, picture, kernel;
  auto operator<=>(const Place&) const = default;
};

/// All tries of one kernel in one work-group.
struct Result {
  Place place;
  Shape shape;
  Validity validity = Validity::correct;
  std::vector<double> run_ms;  ///< The kernel's time in each picture; the latest last.
};

/// "small", "hd" or "uhd" by the pixels of a frame, "narrow" or "wide" by its largest CoC radius:
/// frames of one class are tuned together.
std::string frame_class(std::size_t pixels, double largest_coc_px);

/// The same for a point cloud, whose circles nobody knows beforehand: "hd cloud".
std::string cloud_class(std::size_t pixels);

/// Of `added` what is new, and its times to those that are there. The latest are kept, of times and
/// of the pictures of a class; what was added last is last.
void merge(std::vector<Result>& results, const std::vector<Result>& added);

/// What is known of a kernel in a picture.
struct Finding {
  Place place;
  Shape own, best;  ///< The launch table's, and the fastest.
  double own_ms = 0, best_ms = 0;
  double low = 1, high = 1;  ///< Quartiles of best / own: pairs of runs.
  std::size_t tried = 0;     ///< Work-groups.
  bool is_adopted = false;   ///< Best is used instead of own.
  /// Of best and own before best, which seems faster, may be used; 0: enough, or it is not.
  std::size_t runs_missing = 0;

  double gain() const { return 1 - best_ms / own_ms; }
};

/// Correct ones at a place, the fastest first.
std::vector<const Result*> tries_at(const std::vector<Result>& results, const Place& place);

/// Of every place where the kernel's own work-group has been measured, the latest last.
std::vector<Finding> findings(const std::vector<Result>& results, bool on_gpu);

/// By kernel, what is used on frames of this class: of several pictures, the latest's.
std::map<std::string, Shape> adopted(const std::vector<Result>& results,
                                     const std::string& frame_class, bool on_gpu);

/// What a try took where nothing got in its way: its shortest run.
double time_of(const Result& result);

}  // namespace defray::tuning
