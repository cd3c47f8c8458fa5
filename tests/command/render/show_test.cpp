// --show under a real X server: keys and mouse events, and what is then on the screen.
#include <array>
#include <cmath>
#include <fstream>

#include "base/srgb.h"
#include "command/program.h"

namespace defray::test::show_test {
namespace {

/// What Xvfb's frame buffer holds, 0xRRGGBB a pixel.
struct Screen {
  std::size_t width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
};

/// An XWD file of 32 bits a pixel: a header of big-endian words, colours, rows.
Screen read_screen(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const auto word = [&](std::size_t i) {
    std::uint32_t value = 0;
    for (std::size_t b = 0; b < 4; ++b) {
      value = value << 8 | static_cast<unsigned char>(bytes.at(4 * i + b));
    }
    return value;
  };
  Screen s;
  s.width = word(4);
  s.height = word(5);
  const std::size_t row = word(12), begin = word(0) + 12 * word(19);
  for (std::size_t y = 0; y < s.height; ++y) {
    for (std::size_t x = 0; x < s.width; ++x) {
      const std::size_t at = begin + y * row + 4 * x;  // B G R, the least first
      s.pixels.push_back(
          static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at)) |
                                     static_cast<unsigned char>(bytes.at(at + 1)) << 8 |
                                     static_cast<unsigned char>(bytes.at(at + 2)) << 16));
    }
  }
  return s;
}

/// The share of the window's pixels that differ.
double difference(const Screen& a, const Screen& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i];
  return static_cast<double>(count) / (200 * 150);
}

/// R G B as they are shown, 0 to 255.
std::vector<Plane> levels_of(const ImageFile& file) {
  std::vector<Plane> levels;
  for (const int channel : {0, 1, 2}) {
    Plane& plane = levels.emplace_back(file.plane(0, channel));
    for (float& value : plane) value = static_cast<float>(std::round(255 * shown_value(value)));
  }
  return levels;
}

/// The mean difference to a picture of the window's size.
double levels_between(const Screen& screen, const std::vector<Plane>& levels) {
  double sum = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < levels[channel].size(); ++i) {
      const std::uint32_t pixel = screen.pixels[i / 200 * screen.width + i % 200];
      const auto level = static_cast<float>(pixel >> (16 - 8 * channel) & 255);
      sum += static_cast<double>(std::fabs(level - levels[channel][i]));
    }
  }
  return sum / (3 * 200 * 150);
}

class ShowWindow : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"Xvfb", "xdotool"}) {
      if (shell(folder_, std::string("command -v ") + name).code != 0) {
        GTEST_SKIP() << "needs Xvfb and xdotool";
      }
    }
    Plane z, colour;
    for (int i = 0; i < 200 * 150; ++i) {
      z.push_back(i % 200 < 100 ? 2.0f : 8.0f);
      colour.push_back(((i % 200) / 6 + i / 200 / 6) % 2 ? 0.8f : 0.1f);
    }
    for (const char* name : {"s.0001.exr", "s.0002.exr"}) {
      ImageFile::from_planes({"R", "G", "B", "Z"}, {colour, colour, colour, z}, 200, 150,
                             Sample::single_float)
          .write(folder_ / name);
      for (float& value : colour) value = 0.9f - value;
    }
  }
  /// Runs --show on the two frames, does `events` (xdotool's on $window, `snap NAME`), and gives
  /// what the program printed.
  Result show(const std::string& options, const std::string& events) const {
    return show_command("render s.####.exr -o o.####.exr --show " + options, events);
  }
  Result show_command(const std::string& command, const std::string& events) const {
    // Nothing waits for ever: a key that the window never gets would be a test that never ends.
    std::ofstream(folder_ / "events.sh")
        << "Xvfb -displayfd 3 -screen 0 640x480x24 -fbdir . 3>display >/dev/null 2>&1 & server=$!\n"
        << "for i in $(seq 600); do [ -s display ] && break; sleep 0.1; done\n"
        << "export DISPLAY=:$(cat display); unset WAYLAND_DISPLAY\n"
        << "timeout -k 5 300 " << program() << " " << command << " >said 2>err & job=$!\n"
        << "window=$(timeout 120 xdotool search --sync --onlyvisible --name defray | head -1)\n"
        << "settle() { old=; for i in $(seq 40); do sleep 0.2; new=$(md5sum <Xvfb_screen0); "
           "[ \"$new\" = \"$old\" ] && break; old=$new; done; }\n"
        << "titled() { for i in $(seq 100); do xdotool getwindowname $window | grep -qF -- \"$1\" "
           "&& return; sleep 0.1; done; echo \"never titled $1\" >&2; missed=1; }\n"
        << "snap() { settle; cp Xvfb_screen0 $1.xwd; }\n"
        << "key() { xdotool windowfocus $window key --window $window $1; settle; }\n"
        << "[ -n \"$window\" ] || { echo 'no window appeared' >&2; kill $job; }\n"
        << "sleep 1\n"
        << events
        << "\nkey q\nwait $job; code=$?; kill $server; wait $server; exit $((code + "
           "${missed:-0}))\n";
    Result result = shell(folder_, "bash events.sh");
    result.out = shell(folder_, "cat said").out;
    result.err += shell(folder_, "cat err").out;
    EXPECT_EQ(result.code, 0) << result.err;
    return result;
  }
  Screen screen(const std::string& name) const { return read_screen(folder_ / (name + ".xwd")); }
  Folder folder_;
  const std::string lens_ = "--focus 8 --fstop 0.5 --focal-length 50 ";
};

TEST_F(ShowWindow, KeysChangeTheLensUntilOneEndsIt) {
  const Result result = show("--focus 3 --fstop 0.5 --focal-length 50",
                             "key space; titled before; key bracketleft; titled 'focus 2.941,'; "
                             "key plus; titled f/0.5612; key bracketright; titled 'focus 3,'; "
                             "key bracketright; titled 'focus 3.06,'; key minus; titled f/0.5");
  EXPECT_NE(result.out.find(" --focus 3.06 --fstop 0.5\n"), std::string::npos) << result.out;
}

TEST_F(ShowWindow, KeysAndTheMouseChangeTheLens) {
  SKIP_UNLESS_FULL();
  const Result result =
      show(lens_,
           "snap begin; key c; titled CoC; snap near_coc; key c; key space; titled before; snap "
           "before; key space; snap "
           "after\n"
           "xdotool mousemove --window $window 30 70 click 4; titled 'focus 8.16,'\n"
           "xdotool click 1; titled 'focus 2,'; snap near\n"
           "key c; titled CoC; snap coc; key c; snap no_coc\n"
           "key plus; titled f/0.5612; key plus; titled f/0.6299; key plus; titled f/0.707; "
           "snap closed\n"
           "xdotool windowsize $window 300 225; snap large; key 1; snap actual; key 1; snap again\n"
           "xdotool windowsize $window 200 150; settle\n"
           "key p; titled 'frame 1,'; snap other");
  const Screen begin = screen("begin");
  EXPECT_GT(difference(begin, screen("before")), 0.02) << "before is sharp";
  EXPECT_EQ(difference(begin, screen("after")), 0);
  EXPECT_GT(difference(begin, screen("near")), 0.02) << "focus has moved";
  EXPECT_GT(difference(screen("near"), screen("coc")), 0.02);
  EXPECT_EQ(difference(screen("near"), screen("no_coc")), 0);
  // Near red or in focus green on the left, in focus or behind, blue, on the right.
  const auto tint = [&](const std::string& name) {
    std::array<std::array<double, 3>, 2> sides{};
    const Screen coc = screen(name);
    for (std::size_t y = 0; y < 140; ++y) {
      for (std::size_t x = 0; x < 200; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          sides[x < 80 ? 0 : 1][c] += (coc.pixels[y * coc.width + x] >> (16 - 8 * c)) & 255;
        }
      }
    }
    return sides;
  };
  const auto coc = tint("coc"), near_coc = tint("near_coc");
  EXPECT_GT(coc[0][1], 1.3 * coc[0][2]);
  EXPECT_GT(coc[1][2], 1.3 * coc[1][0]);
  EXPECT_GT(near_coc[0][0], 1.3 * near_coc[0][1]);
  EXPECT_GT(near_coc[1][1], 1.3 * near_coc[1][0]);
  EXPECT_GT(difference(screen("large"), screen("actual")), 0.1) << "pixel for pixel";
  EXPECT_EQ(difference(screen("large"), screen("again")), 0);
  EXPECT_GT(difference(screen("near"), screen("closed")), 0.01);
  EXPECT_GT(difference(screen("closed"), screen("other")), 0.02) << "the other frame";
  // The command on exit renders what was seen.
  EXPECT_NE(result.out.find("defray render 's.####.exr' --output 'o.####.exr' --focal-length 50 "
                            "--focus-at 30,70 --fstop 0.707"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.err.find("keys: click"), std::string::npos) << result.err;
}

TEST_F(ShowWindow, ArrowsMoveFocusAndFNumber) {
  SKIP_UNLESS_FULL();
  const Result result =
      show(lens_,
           "key Right; titled 'focus 8.16,'; key Left; titled 'focus 8,'\n"
           "key Left; titled 'focus 7.843,'; key Left; titled 'focus 7.689,'\n"
           "key Up; titled f/0.5612; key Up; titled f/0.6299; key Down; titled f/0.5612\n"
           "xdotool mousemove --window $window 30 70 click 5; titled 'focus 7.538,'\n"
           "xdotool keydown ctrl click 4 keyup ctrl; titled f/0.6299\n"
           "key p; titled 'frame 1,'; key n; titled 'frame 2,'; snap end\n"
           // After a click OpenCV's Qt view would keep the arrows, and the wheel enlarge it.
           "xdotool click 1 mousemove 600 400; titled 'focus 2,'; snap clicked\n"
           "xdotool mousemove --window $window 30 70; key Right; titled 'focus 2.04,'\n"
           "xdotool click 4; titled 'focus 2.081,'; key Down; titled f/0.5612; key Up\n"
           "titled f/0.6299; xdotool click 1 mousemove 600 400; titled 'focus 2,'; snap again\n"
           "key bracketright; titled 'focus 2.04,'; key bracketleft; titled 'focus 2,'");
  EXPECT_EQ(difference(screen("clicked"), screen("again")), 0);
  // What is seen is what render makes at preview quality, and at no other.
  const auto levels_from = [&](const std::string& quality) {
    expect_ok(defray(folder_,
                     "render s.0002.exr -o r.png --focal-length 50 --focus-at 30,70 "
                     "--fstop 0.6299 --quality " +
                         quality));
    return levels_between(screen("clicked"), levels_of(ImageFile::read(folder_ / "r.png")));
  };
  EXPECT_EQ(levels_from("preview"), 0);
  EXPECT_GT(levels_from("normal"), 1);
  EXPECT_NE(result.out.find("--focal-length 50 --focus 2 --fstop 0.6299"), std::string::npos)
      << result.out;
}

TEST_F(ShowWindow, APointCloudIsThePictureThatIsWritten) {
  SKIP_UNLESS_FULL();
  show_command(
      "splat --model figure --model-points 2000 --size 200x150 -o o.exr --show "
      "--aperture-diameter 900 --focal-length 50",
      "xdotool mousemove 600 400; titled 'defray: o.exr'; snap seen");
  EXPECT_EQ(levels_between(screen("seen"), levels_of(ImageFile::read(folder_ / "o.exr"))), 0);
}

/// Where what the keys say and what was typed leave a camera file nothing to say, render refuses
/// it.
TEST_F(ShowWindow, TheCommandOnExitRenders) {
  SKIP_UNLESS_FULL();
  std::ofstream(folder_ / "camera.json")
      << R"({"focal_length_mm": 50, "f_stop": 0.5, "focus_distance_m": 8})";
  const Result result = show(
      "--camera camera.json --focal-length 50 --sensor-width 36 --focus 8 --skip-existing "
      "--frames 1-2",
      "key plus; titled f/0.5612");
  std::string command = result.out.substr(result.out.rfind("defray render"));
  command.erase(command.find('\n'));
  EXPECT_EQ(command.find("--camera"), std::string::npos) << command;
  EXPECT_EQ(command.find("--skip-existing"), std::string::npos) << command;
  const std::uint64_t before = file_hash(folder_ / "o.0002.exr");
  expect_ok(shell(folder_, program() + command.substr(6)));
  EXPECT_NE(file_hash(folder_ / "o.0002.exr"), before);
}

}  // namespace
}  // namespace defray::test::show_test
