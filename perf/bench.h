#pragma once
// What the experiments share: a scene before its lens, methods applied to it, and their times.
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "device/device_backend.h"
#include "measure/html_report.h"
#include "methods/method.h"
#include "scenes/subject.h"

namespace defray::perf {

/// How an experiment runs.
struct Bench {
  std::string folder;      ///< Pictures and plots go here.
  DeviceBackend& backend;  ///< Of the device that is measured.
  bool is_quick = false;   ///< Small pictures and few repetitions: to see that it works.
  std::function<void(const std::string& step)> step;  ///< Told before each long step.
  std::string scenes = {};  ///< A folder of ray-traced scenes (truth/places.h); empty: none.

  int repetitions() const { return is_quick ? 2 : 5; }
  /// A picture size, a quarter of it when quick.
  int size(int pixels) const { return is_quick ? pixels / 4 : pixels; }
};

/// Seconds of repeated runs.
struct Timing {
  double median_s = 0;
  double spread = 0;  ///< (largest - smallest) / median.
};

double seconds_of(const std::function<void()>& run);

/// Runs once to warm up, then `repetitions` times; `after` each, not timed. More than three
/// repetitions are medians of as many runs as take a tenth of a second: few short ones are chance.
Timing time_of(int repetitions, const std::function<void()>& run,
               const std::function<void()>& after = {});

/// "0.123 s ± 4 %".
std::string to_text(const Timing& timing);

/// A number with so many digits behind the point.
std::string fixed(double value, int digits = 2);

/// Kernel against twin on the picture's middle (96 x 64 pixels). Throws Error(internal) where they
/// differ by a bit.
void check_against_twin(Backend& backend, const Subject& subject, const MethodSettings& settings);

/// Times `render` after check_against_twin, and a check that every run gives the same picture.
/// Throws Error(internal) where it does not.
Timing time_method(const Bench& bench, const Subject& subject, const MethodSettings& settings);

MethodSettings rdb_of(int cells_per_side);
MethodSettings linear_of();
MethodSettings gather_of(GatherKind kind, int samples, int passes);

/// Writes pictures side by side as `name`.png and returns the figure.
Figure sheet(const Bench& bench, const std::string& name, const std::string& caption,
             const std::vector<std::pair<std::string, const std::vector<Plane>*>>& pictures,
             int width, int height);

/// Lens points of an n x n accumulation buffer: the cells' centres squeezed into the disc, so that
/// all n^2 views count (Shirley & Chiu's concentric map).
std::vector<std::array<double, 2>> accumulation_points(int n);

}  // namespace defray::perf
