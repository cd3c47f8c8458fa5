#pragma once
// defray validate, in two files: the kernels (validate.cpp), the arithmetic
// (validate_arithmetic.cpp).
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "measure/html_report.h"

namespace defray::cli {

/// The command line of `defray validate` as typed.
struct ValidateOptions {
  std::string device, folder, only_case, math = "strict";
  std::vector<std::string> kernels;
  bool all = false, quick = false, full = false, tiny = false, arithmetic = false, json = false;
  bool quiet = false;

  /// Text, but for the words of progress.
  bool has_text() const { return !quiet && !json; }
};

/// Measures what relaxed arithmetic buys and costs; the exit code.
int run_arithmetic(const ValidateOptions& options);

/// Writes report.html, with its pictures inside, and report.json; says so, or prints the JSON.
void write_reports(const ValidateOptions& options, const Page& page,
                   const TemporaryFolder& pictures, const std::string& json);

/// "defray 0.1.0, 2026-01-31".
std::string version_and_date();

}  // namespace defray::cli
