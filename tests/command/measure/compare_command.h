#pragma once
// defray compare, in a folder of its own.
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

}  // namespace defray::test
