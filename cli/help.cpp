#include "help.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace defray::cli {
namespace {

// Lines beyond are hard to read, and texts beside option names in fewer columns than these, too.
constexpr std::size_t most_columns = 120, least_columns = 30;

/// Of the terminal that standard output is, if it is one and knows.
std::optional<std::size_t> columns() {
  winsize size{};
  if (isatty(STDOUT_FILENO) != 1 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return {};
  if (size.ws_col == 0) return {};
  return std::min<std::size_t>(size.ws_col, most_columns);
}

class WrappedHelp : public CLI::Formatter {
 public:
  explicit WrappedHelp(std::size_t columns) : columns_(columns) {}

  std::string make_option_desc(const CLI::Option* option) const override {
    return beside_name(option->get_description());
  }

  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_name(), beside_name(command->get_description()),
                             get_column_width());
    return out.str();
  }

  std::string make_description(const CLI::App* app) const override {
    return wrapped(CLI::Formatter::make_description(app), columns_);
  }

 private:
  std::string beside_name(const std::string& text) const {
    const std::size_t name = std::min(get_column_width(), columns_);
    return wrapped(text, std::max(columns_ - name, least_columns));
  }

  std::size_t columns_;
};

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::string out;
  std::size_t line = 0;  // where the last begins
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
    if (out.size() > line && out.size() - line + end - begin > width) {
      out.back() = '\n';  // instead of the space
      line = out.size();
    }
    out.append(text, begin, end - begin + 1);
    if (end < text.size() && text[end] == '\n') line = out.size();
    begin = end + 1;
  }
  return out;
}

std::shared_ptr<CLI::Formatter> help_format() {
  const std::optional<std::size_t> width = columns();
  return width ? std::make_shared<WrappedHelp>(*width) : std::make_shared<CLI::Formatter>();
}

std::vector<std::string> arguments_of(int argc, char** argv, const CLI::App& app) {
  std::vector<std::string> all(argv + std::min(argc, 1), argv + argc);
  if (!all.empty() && all.front() == "help") {
    while (!all.empty() && all.front() == "help") all.erase(all.begin());
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    const bool is_known =
        all.empty() || std::any_of(commands.begin(), commands.end(), [&](const CLI::App* command) {
          return command->get_name() == all.front();
        });
    if (is_known) all.push_back("--help");  // else the name is what is wrong
  }
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace defray::cli
