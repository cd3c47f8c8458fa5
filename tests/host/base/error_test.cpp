// Errors name fields of settings; what shows them may name them otherwise.
#include "support.h"

namespace defray::test::error_test {
namespace {

TEST(Error, NamesFieldsPlainlyUnlessToldOtherwise) {
  try {
    fail(ErrorKind::usage, "{} is {}: it goes with {}", field("squeeze"), 9, field("blades"));
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "squeeze is 9: it goes with blades");
    EXPECT_EQ(with_field_names(error.marked(), [](const auto& name) { return "--" + name; }),
              "--squeeze is 9: it goes with --blades");
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return;
  }
  ADD_FAILURE() << "no error was thrown";
}

TEST(Error, LeavesTextWithoutFieldsAlone) {
  const auto shout = [](const std::string& name) { return name + "!"; };
  EXPECT_EQ(with_field_names("", shout), "");
  EXPECT_EQ(with_field_names("a plain text", shout), "a plain text");
  EXPECT_EQ(with_field_names(field("a") + field("b"), shout), "a!b!");
  EXPECT_EQ(with_field_names("half a mark \x1f here", shout), "half a mark \x1f here");
}

}  // namespace
}  // namespace defray::test::error_test
