#pragma once
// Standard input, output and error: closed ones, broken ones, pictures in them.
#include <optional>
#include <string>

#include "base/temporary_folder.h"

namespace defray::cli {

/// Opens those that are closed, on /dev/null: else files get their numbers, and what is printed. A
/// reader that goes away is an error of a write then, not the end.
void open_standard_streams();

/// Whether what was printed has gone out. That the reader of a pipe has gone is no error: it has
/// what it wanted, and is_output_lost() does not count it.
bool flush_output();

/// Whether something that was printed was lost: a full disk.
bool is_output_lost();

/// Whether standard output was closed when the program began.
bool was_output_closed();

/// A line to standard error, whatever is wrong there.
void print_error(const std::string& line) noexcept;

/// Pictures from standard input and to standard output, as files for the time between. What is
/// printed goes to standard error then.
class PictureStreams {
 public:
  static constexpr const char* name = "-";

  /// Replaces names that are "-". Throws Error(input) where standard input holds no picture,
  /// Error(output) where it cannot be copied or standard output is closed.
  PictureStreams(std::string& input, std::string& output);

  /// Writes the output, if it is to go there. Throws Error(output).
  void finish();

  /// A text in which the files are called what their user calls them: "-", or "standard input" in a
  /// sentence.
  std::string named(std::string text) const;

 private:
  void copy_input(const std::string& bytes, const std::string& extension);

  std::optional<TemporaryFolder> folder_;  ///< Where there is something to put into it.
  std::string input_, output_;
  int standard_output_ = -1;
};

}  // namespace defray::cli
