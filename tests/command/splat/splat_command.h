#pragma once
// What tests of defray splat share.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command/program.h"

namespace defray::test::splat_command_test {
using nlohmann::json;

inline const std::string figure = "splat --model figure --model-points 2000 --size 64x64 ";
inline const std::string wide_lens = "--aperture-diameter 3000 --focal-length 50 ";

class SplatCommand : public testing::Test {
 protected:
  json render(const std::string& options, const std::string& output = "o.exr") const {
    const Result result = defray(folder_, figure + "--json -o " + output + " " + options);
    expect_ok(result);
    return json::parse(result.out.substr(0, result.out.find('\n')));
  }
  std::uint64_t hash(const std::string& options) const {
    render(options);
    return file_hash(folder_ / "o.exr");
  }
  void refused(const std::string& arguments, int code,
               const std::vector<std::string>& words) const {
    expect_refusal(defray(folder_, arguments), code, words, arguments);
  }
  /// ball.xyz, 600 points and their normals, if any, turned outwards (1) or inwards (-1).
  void write_ball(double outwards) const {
    std::ofstream points(folder_ / "ball.xyz");
    for (int i = 0; i < 600; ++i) {
      const double y = (i + 0.5) / 300 - 1, turn = 2.399963 * i, across = std::sqrt(1 - y * y);
      const double x = across * std::cos(turn), z = across * std::sin(turn);
      points << x << ' ' << y << ' ' << z;
      if (outwards != 0)
        points << ' ' << outwards * x << ' ' << outwards * y << ' ' << outwards * z;
      points << '\n';
    }
  }
  Folder folder_;
};

}  // namespace defray::test::splat_command_test
