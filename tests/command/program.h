#pragma once
// Runs the built program as a user would, and makes the pictures it is given.
#include <map>
#include <string>
#include <vector>

#include "image/image_file.h"
#include "support.h"

namespace defray::test {

struct Result {
  int code = 0;
  std::string out, err;
};

/// Runs `defray ARGUMENTS` through the shell, in `folder`, after `prefix` (variables, wrappers).
Result defray(const Folder& folder, const std::string& arguments, const std::string& prefix = "");

/// Runs any shell command in `folder`.
Result shell(const Folder& folder, const std::string& command);

/// The program's path, quoted for the shell.
std::string program();

/// Writes `name`: channels of this size, each from random_plane but depths (…Z) from 1 to 9.
void write_picture_file(const Folder& folder, const std::string& name,
                        const std::vector<std::string>& channels, Size size = {48, 32});

/// Hash of every channel of every part of a file.
std::uint64_t file_hash(const std::string& path);

inline void expect_ok(const Result& result) { EXPECT_EQ(result.code, 0) << result.err; }

/// One line "PROGRAM: error: …" that holds the words, this exit code, and nothing on standard
/// output.
void expect_refusal(const Result& result, int code, const std::vector<std::string>& words,
                    const std::string& command);

/// A complete lens for render's command line.
inline const std::string lens = " --focus 3 --fstop 0.5 --focal-length 50 ";

}  // namespace defray::test
