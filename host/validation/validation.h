#pragma once
// Every kernel against its scalar twin on one device.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "image/display.h"
#include "opencl/session_options.h"
#include "validation/grid.h"
#include "validation/verdict.h"

namespace defray {
class Session;
struct DeviceInfo;
}  // namespace defray

namespace defray::validation {

/// What one kernel showed on one device.
struct KernelResult {
  std::string kernel, rule;
  std::size_t cases = 0;
  Verdict verdict;
  std::string worst_case;    ///< Of the largest difference; empty where there is none.
  std::string first_wrong;   ///< The first case beyond the rule.
  std::string error;         ///< An OpenCL error, with its case; the rest was not run.
  std::size_t unstable = 0;  ///< Cases whose second run, in buffers filled with other bytes, gave
                             ///< other bits.
  std::uint64_t hash = 0;    ///< Of all results of the device, equal where devices agree.
  double seconds = 0;
  bool passed() const { return verdict.wrong == 0 && unstable == 0 && error.empty(); }
};

/// Kernel, twin and their difference where they lie farthest apart.
struct WorstPicture {
  std::string kernel, case_text;
  int width, height;
  std::vector<SheetPanel> panels;
};

/// One case's sums against exact ones: roundings that the derived bound allows, and the share that
/// was used.
struct ExactPoint {
  std::string kernel;
  double roundings, share;
};

struct DeviceResult {
  std::string device, platform, version;
  std::string math;
  std::string watch;  ///< What a simulator looked for beside values; empty: nothing.
  std::vector<KernelResult> kernels;
  std::vector<ExactPoint> exact;
  std::vector<WorstPicture> pictures;  ///< Of kernels with differences.
  bool passed() const;
};

struct Settings {
  Level level = Level::quick;
  std::vector<std::string> kernels;  ///< Empty: all.
  std::string only_case;             ///< This case instead of the grid.
  SessionOptions session;
  bool stops_at_first = false;  ///< Of a kernel's cases, none after the first that fails.
  /// Work-group {group_x, 1} for all cases, 0: the kernel's default; empty: each case its own.
  std::optional<int> group_x;
};

/// Runs the checks; on a simulator the smallest frames whatever the level. `progress` gets the
/// share done, 0 to 1, and the kernel at work.
DeviceResult validate_device(const DeviceInfo& info, const Settings& settings,
                             const std::function<void(double, const std::string&)>& progress = {});

/// The check of this name. Throws Error(usage), with the names there are.
const KernelCheck& find_check(const std::string& kernel);

/// What kernel and twin gave for one case.
struct Run {
  Input input;
  Outcome kernel, twin;
};
/// With the case's work-group and bands.
Run run_case(Session& session, const KernelCheck& check, const Case& c);

/// The kernel's part of it again.
Outcome run_kernel(Session& session, const KernelCheck& check, const Case& c, const Input& input);

}  // namespace defray::validation
