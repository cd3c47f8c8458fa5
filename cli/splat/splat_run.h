#pragma once
// defray splat over its pictures: while one is drawn the last is written.
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "base/plane.h"
#include "frame_report.h"
#include "progress.h"
#include "splat/splat_report.h"
#include "splat/splat_shots.h"

namespace defray::cli {

/// Whether --skip-existing leaves this picture alone.
bool is_skipped(const SplatCommand& job, const SplatShot& shot);

/// A picture that has been written.
struct WrittenSplats {
  SplatShot shot;
  SplatOutcome outcome;
  std::vector<Plane> colour;
};

class SplatRun {
 public:
  /// `source` is what the points are of, for reports.
  SplatRun(const SplatCommand& job, Device& device, const SplatModel& model, std::string source,
           double ready_seconds);

  /// Draws and writes all, and tells about each in its order. Throws the Error of the first that
  /// fails.
  void draw(const std::vector<SplatShot>& shots);

  /// The last picture that was drawn.
  const std::optional<WrittenSplats>& last() const { return last_; }

 private:
  std::future<WrittenSplats> write_later(const SplatShot& shot, SplatCamera camera,
                                         SplatResult result, double seconds) const;
  void finish(std::future<WrittenSplats>& writing);

  const SplatCommand& job_;
  Device& device_;
  const SplatModel& model_;
  const std::string source_;
  double ready_seconds_;  ///< Of the cloud; counted with the first picture.
  std::optional<WrittenSplats> last_;
  FrameNotes notes_;
};

}  // namespace defray::cli
