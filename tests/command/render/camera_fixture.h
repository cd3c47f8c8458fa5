#pragma once
// Pictures to try a camera on, and what the report says of it.
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test {

class Camera : public testing::Test {
 protected:
  Camera() {
    write_picture_file(folder_, "wide.exr", {"R", "G", "B", "Z"}, {48, 32});
    write_picture_file(folder_, "tall.exr", {"R", "G", "B", "Z"}, {32, 48});
  }
  nlohmann::json report(const std::string& arguments) const {
    const Result result = defray(folder_, "render " + arguments + " --json");
    expect_ok(result);
    return nlohmann::json::parse(result.out.substr(0, result.out.find('\n')));
  }
  double sensor(const std::string& arguments) const {
    return report(arguments + " -o o.exr --focus 3 --fstop 2 --focal-length 50")["sensor_width_mm"];
  }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) const {
    expect_refusal(defray(folder_, "render " + arguments), code, words, arguments);
  }
  Folder folder_;
};

}  // namespace defray::test
