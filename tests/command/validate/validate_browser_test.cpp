// The report of defray validate as a browser shows it.
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "command/program.h"

namespace defray::test::validate_browser_test {
namespace {

/// Runs Chromium on the page, which must not complain; what it prints.
std::string browse(const Folder& folder, const std::string& options) {
  const Result result =
      shell(folder,
            "HOME=\"$PWD\" timeout 60 chromium --headless --no-sandbox --disable-gpu "
            "--disable-dev-shm-usage --enable-logging=stderr --user-data-dir=\"$PWD/profile\" " +
                options + " \"file://$PWD/report/report.html\"");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err.find("CONSOLE"), std::string::npos) << result.err;
  return result.out;
}

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

std::vector<unsigned char> from_base64(const std::string& text) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c) & 63);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> count & 255));
  }
  return bytes;
}

TEST(Validate, ReportOpensInABrowser) {
  const Folder folder;
  if (shell(folder, "command -v chromium").code != 0) GTEST_SKIP() << "chromium is not installed";
  expect_ok(defray(folder, "validate --kernel coc --kernel rdb_merge -o report"));
  const std::string page = browse(folder, "--dump-dom");
  EXPECT_NE(page.find(" checks pass, "), std::string::npos);
  EXPECT_GE(all_matches(page, "(<td class=\"pass[^>]*>PASS</td>)").size(), 4u);

  // The page is all there is: no file, no network.
  const std::string bytes = "data:image/png;base64,";
  std::size_t pictures = 0;
  for (std::size_t at = page.find("<img src=\""); at != std::string::npos;
       at = page.find("<img src=\"", at + 1), ++pictures) {
    const std::size_t begin = at + 10, end = page.find('"', begin);
    const std::string source = page.substr(begin, end - begin);
    ASSERT_EQ(source.rfind(bytes, 0), 0u) << source.substr(0, 80);
    const cv::Mat image = cv::imdecode(from_base64(source.substr(bytes.size())), cv::IMREAD_COLOR);
    EXPECT_GT(image.cols, 50);
  }
  EXPECT_GE(pictures, 2u);  // the worst case of coc, the plot of the bounds
  EXPECT_EQ(all_matches(page, "(src=)").size(), pictures);
  EXPECT_TRUE(all_matches(page, "((?:href=|url\\(|@import|https?://)[^ ]{0,40})").empty());

  browse(folder, "--window-size=1200,2000 --screenshot=shot.png");
  const cv::Mat shot = cv::imread(folder / "shot.png");
  ASSERT_EQ(shot.cols, 1200);
  cv::Mat mean, spread;
  cv::meanStdDev(shot, mean, spread);
  EXPECT_GT(spread.at<double>(0), 10);  // something is drawn
}

}  // namespace
}  // namespace defray::test::validate_browser_test
