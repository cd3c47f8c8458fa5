#pragma once
// defray render on pictures of 24x16 pixels with what looks like a mistake.
#include "command/program.h"

namespace defray::test {

class Mistakes : public testing::Test {
 protected:
  static constexpr int width = 24, height = 16, pixels = width * height;

  void write(const std::string& name, const std::vector<std::string>& further,
             const std::vector<Plane>& planes) const {
    std::vector<std::string> channels{"R", "G", "B"};
    std::vector<Plane> all(3, Plane(pixels, 0.5f));
    channels.insert(channels.end(), further.begin(), further.end());
    all.insert(all.end(), planes.begin(), planes.end());
    ImageFile::from_planes(channels, all, width, height, Sample::single_float)
        .write(folder_ / name);
  }
  std::string said(const std::string& arguments) const {
    const Result result = defray(folder_, "render " + arguments);
    expect_ok(result);
    return result.out;
  }
  void expect_note(const std::string& arguments, const std::string& words) const {
    const std::string text = said(arguments);
    EXPECT_NE(text.find("note: " + words), std::string::npos) << arguments << "\n" << text;
  }
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    expect_refusal(defray(folder_, "render " + arguments), 3, words, arguments);
  }

  Folder folder_;
  const std::string usual_ = lens + "--sensor-width 36 ";
};

}  // namespace defray::test
