#pragma once
// What defray splat prints about a picture.
#include <string>
#include <vector>

#include "splat/splat_shots.h"

namespace defray::cli {

/// A picture that was made.
struct SplatOutcome {
  std::string input;  ///< The cloud's file, or "model figure".
  std::string device;
  SplatCamera camera;
  SplatReport report;
  double ready_seconds = 0;  ///< Of the cloud, with the first picture of it.
  double render_seconds = 0;
  std::vector<std::string> notes;
};

/// Of a picture that --skip-existing leaves alone, as text or JSON.
void print_skipped(const SplatCommand& job, const SplatShot& shot);

/// One JSON line.
void print_json(const SplatShot& shot, const SplatOutcome& outcome);

/// With these notes.
void print_text(const SplatShot& shot, const SplatOutcome& outcome,
                const std::vector<std::string>& notes);

}  // namespace defray::cli
