#pragma once
// What defray render prints about a frame.
#include <optional>
#include <string>
#include <vector>

#include "defray/io.h"

namespace defray::cli {

/// What became of one frame.
struct FrameOutcome {
  std::optional<int> frame;  ///< Empty for a single picture.
  FramePaths paths;
  std::string status;  ///< ok, skipped, failed.
  std::string error;
  FrameReport report;  ///< Of an ok frame.
};

/// The library's notes and those on what the report counts, with options for the settings in them.
std::vector<std::string> notes_of(const FrameReport& report);

/// With these notes.
void print_text(const FrameOutcome& outcome, const std::vector<std::string>& notes,
                const std::string& device);
/// Backend and tiles of a frame that went through the chain.
void print_stats(const FrameReport& report);
void print_json_line(const FrameOutcome& outcome, const std::string& device);

}  // namespace defray::cli
