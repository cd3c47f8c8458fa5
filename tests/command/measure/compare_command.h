#pragma once
// defray compare, in a folder of its own.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test {

class CompareCommand : public testing::Test {
 protected:
  int code(const std::string& arguments) { return defray(folder_, "compare " + arguments).code; }

  void refuse(const std::string& arguments, int code, const std::vector<std::string>& words) {
    expect_refusal(defray(folder_, "compare " + arguments), code, words, arguments);
  }

  Folder folder_;
};

/// Two pictures, a.exr and b.exr, whose difference is a column, and what else may go with them.
class ComparePictures : public CompareCommand {
 protected:
  ComparePictures() {
    write_picture_file(folder_, "a.exr", {"R", "G", "B"});
    write_picture_file(folder_, "alpha.exr", {"R", "G", "B", "A"});
    write_picture_file(folder_, "small.exr", {"R", "G", "B", "Z"}, {20, 10});
    write_picture_file(folder_, "depth_only.exr", {"Z"});
    const ImageFile a = ImageFile::read(folder_ / "a.exr");
    std::vector<Plane> planes;
    for (int c = 0; c < 3; ++c) planes.push_back(a.plane(0, c));  // stored as R G B
    // Half the frame is near, half far; the difference lies in a column far from that edge.
    Plane depth(planes[0].size());
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth[i] = i % 48 < 24 ? 3 : 6;
      if (i % 48 == 2) planes[0][i] += 0.5f;
    }
    ImageFile::from_planes({"R", "G", "B"}, planes, 48, 32, Sample::single_float)
        .write(folder_ / "b.exr");
    ImageFile::from_planes({"Z"}, {depth}, 48, 32, Sample::single_float).write(folder_ / "z.exr");
    write_camera("camera.json", R"({"only": {"focus_distance_m": 3, "f_stop": 1}})");
    write_camera("two.json", R"({"near": {"focus_distance_m": 3, "f_stop": 1},
                                 "open": {"focus_distance_m": 3, "f_stop": 0.02}})");
  }

  void write_camera(const std::string& name, const std::string& settings) {
    std::ofstream(folder_ / name) << R"({"focal_length_mm": 50, "focus_settings": )" << settings
                                  << "}";
  }

  nlohmann::json compared(const std::string& arguments) {
    const Result result = defray(folder_, "compare --json " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  }
};

}  // namespace defray::test
