#pragma once
// What defray tune tells.
#include <string>
#include <vector>

#include "tuning/tuning_file.h"

namespace defray::cli {

struct TuneReport {
  tuning::Key key;
  std::string path;  ///< Of the file of results.
  std::vector<tuning::Result> results;
  std::vector<tuning::Finding> findings;  ///< Of them.
};

void print_text(const TuneReport& report);
void print_json(const TuneReport& report);

/// index.html and tuning.csv, with a heat map a kernel and class.
void write_report(const std::string& folder, const TuneReport& report);

}  // namespace defray::cli
