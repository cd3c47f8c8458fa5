// Whether a window can be opened.
#include "image/display.h"

#include <cstdlib>
#include <optional>

#include "support.h"

namespace defray::test::display_test {
namespace {

/// DISPLAY alone, while it lives; then as it was.
class With {
 public:
  explicit With(const char* display) : x11_("DISPLAY", display), wayland_("WAYLAND_DISPLAY", "") {}

 private:
  struct Variable {
    Variable(const char* variable, const char* value) : name(variable) {
      if (const char* old = std::getenv(name)) before = old;
      setenv(name, value, 1);
    }
    ~Variable() {
      if (before) {
        setenv(name, before->c_str(), 1);
      } else {
        unsetenv(name);
      }
    }
    const char* name;
    std::optional<std::string> before;
  };
  Variable x11_, wayland_;
};

TEST(Display, ADeadOneIsNone) {
  const With dead(":397");
  std::string why;
  EXPECT_FALSE(has_display(why));
  EXPECT_EQ(why, "DISPLAY is :397, but no X server answers there");
}

TEST(Display, ARemoteOneIsForTheToolkitToFind) {
  const With remote("far:397");
  std::string why;
  EXPECT_TRUE(has_display(why));
}

TEST(Display, NoneAtAll) {
  const With none("");
  std::string why;
  EXPECT_FALSE(has_display(why));
  EXPECT_NE(why.find("neither DISPLAY"), std::string::npos);
}

}  // namespace
}  // namespace defray::test::display_test
