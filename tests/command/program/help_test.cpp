// Help: of a command, and as wide as the terminal.
#include "help.h"

#include <algorithm>
#include <sstream>

#include "command/program.h"

namespace defray::test::help_test {
namespace {

std::string help_of(const std::string& arguments) {
  const Result result = defray(Folder(), arguments);
  expect_ok(result);
  return result.out;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    line.erase(std::remove(line.begin(), line.end(), '\r'), line.end());
    lines.push_back(line);
  }
  return lines;
}

/// Before what is written below the options as it is, examples among it.
std::size_t longest(const std::vector<std::string>& lines) {
  std::size_t most = 0;
  for (const std::string& line : lines) {
    if (line.starts_with("Diffraction")) break;
    most = std::max(most, line.size());
  }
  return most;
}

TEST(HelpText, LinesBreakAtSpaces) {
  EXPECT_EQ(cli::wrapped("a lens has an iris", 9), "a lens\nhas an\niris");
  EXPECT_EQ(cli::wrapped("a lens has an iris", 10), "a lens has\nan iris");
  EXPECT_EQ(cli::wrapped("diaphragms are irises", 4), "diaphragms\nare\nirises");
  EXPECT_EQ(cli::wrapped("an\niris and a lens", 7), "an\niris\nand a\nlens");
  EXPECT_EQ(cli::wrapped("", 5), "");
}

TEST(HelpText, OfACommandIsAskedForInBothWays) {
  EXPECT_EQ(help_of("help"), help_of("--help"));
  EXPECT_EQ(help_of("help help"), help_of("--help"));
  EXPECT_EQ(help_of("help psf"), help_of("psf --help"));
  EXPECT_NE(help_of("help psf"), help_of("help sheet"));
  const Folder folder;
  expect_refusal(defray(folder, "help pfs"), 2,
                 {"unknown command 'pfs'. Did you mean 'psf'? See 'defray --help'"}, "help pfs");
}

TEST(HelpText, IsAsWideAsATerminal) {
  const Folder folder;
  const auto shown = [&](const std::string& terminal, const std::string& command) {
    const Result result =
        shell(folder, "script -qec \"" + terminal + program() + " " + command + "\" /dev/null");
    expect_ok(result);
    return lines_of(result.out);
  };
  EXPECT_LE(longest(shown("stty cols 72; ", "psf --help")), 72u);
  EXPECT_LE(longest(shown("stty cols 500; ", "scene --help")), 120u);
  // Where nobody looks each option is a line.
  const std::vector<std::string> lines = lines_of(help_of("render --help"));
  EXPECT_GT(longest(lines), 120u);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("--channels") != std::string::npos && line.ends_with("integers (rdb)");
  }));
}

}  // namespace
}  // namespace defray::test::help_test
