#pragma once
// What tests of defray splat share.
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
  Folder folder_;
};

}  // namespace defray::test::splat_command_test
