// defray render --channels: which channels of a file the lens changes, and how.
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <fstream>

#include "command/program.h"
#include "image/channel_names.h"

namespace defray::test::channels_command_test {
namespace {

const std::vector<std::string> all_channels{
    "R", "G", "B", "A", "Z", "diffuse.R", "diffuse.G", "diffuse.B", "AO", "N.X", "N.Y", "N.Z"};

struct ChannelsCommand : testing::Test {
  Folder folder;
  void SetUp() override { write_picture_file(folder, "in.exr", all_channels); }

  /// Planes of the file by name.
  static std::map<std::string, Plane> planes(const std::string& path) {
    const ImageFile file = ImageFile::read(path);
    std::map<std::string, Plane> by_name;
    for (const ChannelName& n : channel_names(file.parts())) {
      by_name[n.full] = file.plane(n.part, n.channel);
    }
    return by_name;
  }
  std::map<std::string, Plane> rendered(const std::string& options) {
    expect_ok(defray(folder, "render in.exr -o out.exr" + lens + options));
    return planes(folder / "out.exr");
  }
  void expect_refused(int code, const std::string& options, const std::vector<std::string>& words,
                      const std::string& input = "in.exr", const std::string& out = "none.exr") {
    expect_refusal(defray(folder, "render " + input + " -o " + out + " " + options), code, words,
                   options);
    EXPECT_FALSE(std::filesystem::exists(folder / out));
  }
};

TEST_F(ChannelsCommand, OnlyChosenChannelsChangeAndColourDoesNot) {
  const auto in = planes(folder / "in.exr");
  for (const std::string more : {"", "--literal "}) {
    const auto plain = rendered(more);
    const auto chosen = rendered(more + "--channels 'diffuse.*,N.*'");
    for (const std::string& name : all_channels) {
      const bool is_chosen = name.starts_with("diffuse") || name.starts_with("N.");
      EXPECT_EQ(chosen.at(name) == plain.at(name), !is_chosen) << more << name;
      const bool is_colour = name.size() == 1 && name != "Z";
      if (!is_colour) {
        EXPECT_EQ(plain.at(name), in.at(name)) << name;
      }
    }
  }
}

TEST_F(ChannelsCommand, LightIsWhatTheLensMakesOfItAsColour) {
  const auto chosen = rendered("--channels 'diffuse.*'");
  const auto as_colour = rendered("--layer diffuse");
  for (const char* name : {"diffuse.R", "diffuse.G", "diffuse.B"}) {
    EXPECT_EQ(chosen.at(name), as_colour.at(name)) << name;
  }
  const auto single = rendered("--channels AO");
  EXPECT_NE(single.at("AO"), planes(folder / "in.exr").at("AO"));
}

// Whole vectors move: no value is new, and X, Y and Z stay together.
TEST_F(ChannelsCommand, DataAreMovedNotMixed) {
  const auto in = planes(folder / "in.exr");
  using Vector = std::array<float, 4>;
  const auto vectors = [](const std::map<std::string, Plane>& p) {
    std::vector<Vector> v;
    for (std::size_t i = 0; i < p.at("Z").size(); ++i) {
      v.push_back({p.at("N.X")[i], p.at("N.Y")[i], p.at("N.Z")[i], p.at("Z")[i]});
    }
    return v;
  };
  const std::vector<Vector> before = vectors(in);
  for (const std::string more : {"", "--literal ", "--device reference ", "--rdb 33 "}) {
    const std::vector<Vector> after = vectors(rendered(more + "--channels 'N.*,Z'"));
    int nearer = 0, farther = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_NE(std::find(before.begin(), before.end(), after[i]), before.end()) << i;
      nearer += after[i][3] < before[i][3];
      farther += after[i][3] > before[i][3];
    }
    EXPECT_GT(nearer, 100) << more;
    EXPECT_GT(nearer, 2 * farther) << more;
  }
}

TEST_F(ChannelsCommand, KernelsGiveTheTwinsBits) {
  for (const std::string more : {"", "--literal "}) {
    const std::string options = more + "--channels '*'";
    const auto kernels = rendered(options);
    EXPECT_EQ(kernels, rendered(options + " --device reference")) << more;
    EXPECT_EQ(kernels, rendered(options + " --memory 4")) << more;
  }
}

/// An EXR with colour in half floats, depth, and 32-bit ids too large for floats, whose upper
/// halves go with their lower ones.
void write_ids(const std::string& path) {
  constexpr int width = 16, height = 8;
  OIIO::ImageSpec spec(width, height, 5, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "Z", "thing"};
  spec.channelformats.assign(3, OIIO::TypeDesc::HALF);
  spec.channelformats.push_back(OIIO::TypeDesc::FLOAT);
  spec.channelformats.push_back(OIIO::TypeDesc::UINT);
  std::vector<std::uint16_t> words;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    words.insert(words.end(), {0x2e66, 0x3266, 0x34cd});  // 0.1, 0.2, 0.3
    const auto z = std::bit_cast<std::uint32_t>(i % width < 8 ? 1.0f : 4.0f);
    for (const std::uint32_t word : {z, ((0xff00u + i % width) << 16) + i % width}) {
      words.push_back(static_cast<std::uint16_t>(word));
      words.push_back(static_cast<std::uint16_t>(word >> 16));
    }
  }
  const auto file = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(file->open(path, spec));
  ASSERT_TRUE(file->write_image(OIIO::TypeDesc::UNKNOWN, words.data()));
  file->close();
}

std::vector<std::uint32_t> read_ids(const std::string& path) {
  const auto file = OIIO::ImageInput::open(path);
  std::vector<std::uint32_t> ids(16 * 8);
  EXPECT_TRUE(file->read_image(0, 0, 4, 5, OIIO::TypeDesc::UINT, ids.data()));
  return ids;
}

TEST_F(ChannelsCommand, WholeNumbersAreDataBitForBit) {
  write_ids(folder / "ids.exr");
  const auto before = read_ids(folder / "ids.exr");
  expect_ok(defray(folder, "render ids.exr -o out.exr --channels thing" + lens));
  const auto after = read_ids(folder / "out.exr");
  EXPECT_NE(after, before);
  for (const std::uint32_t id : after) EXPECT_EQ(id >> 16, 0xff00u + (id & 0xffffu));
}

TEST_F(ChannelsCommand, TellsWhatItTookForWhat) {
  const Result text = defray(folder, "render in.exr -o out.exr --channels 'AO,N.*'" + lens);
  EXPECT_NE(text.out.find("light AO"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("data of the nearest hit N.X"), std::string::npos) << text.out;
  const Result json = defray(folder, "render in.exr -o out.exr --json --channels AO" + lens);
  EXPECT_NE(json.out.find("\"light_channels\":[\"AO\"]"), std::string::npos) << json.out;
  const Result help = defray(folder, "render --help");
  for (const char* words : {"--channels", "crypto", "nearest hit"}) {
    EXPECT_NE(help.out.find(words), std::string::npos) << words;
  }
}

TEST_F(ChannelsCommand, RefusesWhatItCannotDo) {
  expect_refused(3, lens + "--channels difuse.R", {"'difuse.R'", "Did you mean 'diffuse.R'?"});
  expect_refused(3, lens + "--channels 'glossy.*'", {"'glossy.*'", "It has: ", "diffuse.R"});
  expect_refused(3, lens + "--channels G", {"'G' is colour"});
  expect_refused(2, lens + "--channels ''", {"--channels", "empty"});
  expect_refused(2, lens + "--channels AO,", {"--channels", "'AO,'", "empty"});
  expect_refused(2, lens + "--channels AO", {"--channels needs a format", ".exr"}, "in.exr",
                 "none.png");
  for (const std::string method : {"linear", "gather"}) {
    expect_refused(2, lens + "--channels AO --method " + method,
                   {"--channels means nothing to --method " + method});
  }
  expect_refused(2, "--channels AO --method tiltshift", {"--channels means nothing"});
}

TEST_F(ChannelsCommand, NamesThePartOrViewOfForeignChannels) {
  const std::string merge =
      "oiiotool in.exr --ch R,G,B,Z --attrib oiio:subimagename beauty in.exr --ch N.X,N.Y,N.Z "
      "--attrib oiio:subimagename shape --siappend -o parts.exr";
  const Result merged = shell(folder, merge);
  if (merged.code != 0) GTEST_SKIP() << merged.err;
  expect_refused(3, lens + "--channels N.X", {"'N.X' is in part 'shape'", "part 'beauty'"},
                 "parts.exr");
  write_picture_file(folder, "stereo.exr", {"R", "G", "B", "Z", "right.AO"});
  expect_refused(3, lens + "--channels right.AO", {"'right.AO' is of view 'right'"}, "stereo.exr");
}

}  // namespace
}  // namespace defray::test::channels_command_test
