// defray splat: every option changes a picture, every mistake has its line.
#include "splat_command.h"

#include <cmath>
#include <fstream>

namespace defray::test::splat_command_test {
namespace {

TEST_F(SplatCommand, EveryOptionChangesThePicture) {
  const std::uint64_t plain = hash(wide_lens);
  for (const std::string option :
       {"--cutoff 3", "--psf gaussian", "--merge average", "--layers 1", "--two-sided",
        "--transparency 0.5", "--focus 3", "--from 1,1,4", "--look-at 0.3,0,0", "--up 1,0,0",
        "--fov 20", "--sensor-width 30", "--sensor-height 20", "--fov 20 --sensor-fit vertical",
        "--pixel-scale 3000", "--unit ft", "--scale 2", "--perceived-distance 1", "--max-coc 2"}) {
    EXPECT_NE(hash(wide_lens + option), plain) << option;
  }
  EXPECT_NE(hash("--fstop 0.05"), hash("--fstop 0.1"));
  const auto drawn = [&](const char* lod) {
    const Result result = defray(folder_,
                                 "splat --model figure --model-points 20000 --size 64x64 "
                                 "--fstop 0.02 --json -o lod.exr --lod " +
                                     std::string(lod));
    return json::parse(result.out)["drawn"].get<int>();
  };
  EXPECT_LT(drawn("on"), drawn("off"));
  EXPECT_EQ(hash("--fstop 0.1"), hash("--fstop 0.1 --focal-length 50"));
  EXPECT_EQ(hash("--fstop 0.1 --fov 90"), hash("--fstop 0.1 --focal-length 18"));
  EXPECT_EQ(hash(wide_lens + "--device reference"), plain);
  EXPECT_EQ(hash(wide_lens + "--quiet"), plain);
  EXPECT_EQ(hash(wide_lens + "--layers 1000"), plain);
}

TEST_F(SplatCommand, ChannelsAndFormats) {
  render(wide_lens + "--depth --fragments");
  const ImageFile file = ImageFile::read(folder_ / "o.exr");
  EXPECT_EQ(file.parts().front().channels,
            (std::vector<std::string>{"R", "G", "B", "A", "Z", "fragments"}));
  const Plane alpha = file.plane(0, 3), depth = file.plane(0, 4), fragments = file.plane(0, 5);
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    EXPECT_EQ(std::isinf(depth[i]), fragments[i] == 0);
    EXPECT_LE(alpha[i], 1.0001f);
    EXPECT_TRUE(alpha[i] == 0 || fragments[i] > 0);
  }
  for (const std::string output : {"o.png", "o.jpg", "o.tif"}) {
    render(wide_lens, output);
    EXPECT_TRUE(std::filesystem::exists(folder_ / output)) << output;
  }
}

TEST_F(SplatCommand, TheReportSaysWhatWasDrawn) {
  const json sharp = render("--aperture-diameter 0 --focal-length 50");
  const json blurred = render(wide_lens);
  EXPECT_EQ(sharp["points"], 2000);
  EXPECT_LE(blurred["drawn"], sharp["drawn"]);
  EXPECT_EQ(sharp["nearest_coc_px"], 0);
  EXPECT_LT(blurred["nearest_coc_px"], -1);
  EXPECT_GT(blurred["farthest_coc_px"], 1);
  EXPECT_GT(blurred["fragments"], sharp["fragments"]);
  // Focused on what is looked at.
  const double z = sharp["from"][2].get<double>() - sharp["look_at"][2].get<double>();
  EXPECT_NEAR(sharp["focus_distance_units"], z, 1e-6);
  const Result text = defray(folder_, figure + "-o o.exr " + wide_lens);
  expect_ok(text);
  EXPECT_NE(text.out.find("2000 points drawn as "), std::string::npos) << text.out;
  const auto expect_nothing = [&](const char* looks, const std::string& why) {
    const std::string view = "-o o.exr --from 0,0,9 --look-at " + std::string(looks) + wide_lens;
    const std::string nothing =
        "nothing of the cloud is seen: it lies " + why + ": see --from, --look-at";
    const Result away = defray(folder_, figure + view);
    EXPECT_NE(away.out.find("  note: " + nothing + "\n"), std::string::npos) << away.out;
    EXPECT_EQ(away.err, "");
    EXPECT_EQ(json::parse(defray(folder_, figure + view + " --json").out)["notes"].back(), nothing);
  };
  expect_nothing("0,0,20 ", "behind the camera");
  expect_nothing("20,0,9 ", "beside the picture, or is seen from its edge");
  EXPECT_TRUE(sharp["notes"].empty() && sharp["fragments"].is_number_integer());
  EXPECT_GT(sharp["ready_s"], 0.0);
  EXPECT_NE(text.out.find(" s to make the cloud ready\n"), std::string::npos) << text.out;
  EXPECT_FALSE(std::signbit(sharp["nearest_coc_px"].get<double>()));
  EXPECT_TRUE(sharp["render_s"] > 0.0 && sharp["stages_s"]["resolve"] >= 0.0);
}

TEST_F(SplatCommand, TheReportSaysWhatLayersLeaveOut) {
  const std::string mask =
      "splat --model mask --model-points 3000 --size 60x60 -o o.exr " + wide_lens;
  EXPECT_EQ(json::parse(defray(folder_, mask + "--json").out)["spilled"], 0);
  const json one = json::parse(defray(folder_, mask + "--layers 1 --json").out);
  const std::string note =
      one["spilled"].dump() +
      " pixels have more than --layers 1 surfaces to be seen: what lies behind "
      "those is left out";
  EXPECT_GT(one["spilled"], 100);
  EXPECT_EQ(one["notes"].back(), note);
  const Result text = defray(folder_, mask + "--layers 1");
  EXPECT_NE(text.out.find("  note: " + note + "\n"), std::string::npos) << text.out;
}

/// In the words of render.
TEST_F(SplatCommand, TheReportSaysWhatTheLensIs) {
  const auto said = [&](const std::string& optics) {
    const Result result = defray(folder_, figure + "-o o.exr " + optics);
    expect_ok(result);
    return result.out;
  };
  const std::string narrow = said("--fstop 2.8 --focus 3 --sensor-width 24 --unit 10");
  EXPECT_NE(narrow.find("  lens 50 mm, aperture 17.8571 mm (f/2.8), sensor 24 mm, focus 3 units of "
                        "10 m\n"),
            std::string::npos)
      << narrow;
  EXPECT_NE(narrow.find("  note: all CoC radii are below half a pixel, the largest is 0."),
            std::string::npos)
      << narrow;
  const std::string wide = said("--aperture-diameter 5000");
  EXPECT_NE(wide.find("  note: f-number 0.01 is ten times off any real one (0.7 to 64): is it "
                      "right?\n"),
            std::string::npos)
      << wide;
  EXPECT_EQ(wide.find("half a pixel"), std::string::npos) << wide;
  EXPECT_EQ(said("--aperture-diameter 0").find("note:"), std::string::npos);
}

TEST_F(SplatCommand, FilesAreRead) {
  std::ofstream points(folder_ / "p.xyz");
  for (int i = 0; i < 400; ++i) points << i % 20 * 0.1 << ' ' << i / 20 * 0.1 << " 0\n";
  points << "nan 0 0\n";
  points.close();
  const Result result = defray(folder_, "splat p.xyz -o o.exr --size 48x32 " + wide_lens);
  expect_ok(result);
  EXPECT_NE(result.err.find("note: p.xyz: 1 of 401 points have no finite place"),
            std::string::npos);
  EXPECT_EQ(defray(folder_, "splat p.xyz -q -o o.exr --size 48x32 " + wide_lens).err, "");
  const ImageFile file = ImageFile::read(folder_ / "o.exr");
  EXPECT_GT(file.plane(0, 3)[16 * 48 + 24], 0.95f);
  // Seen from behind, too: estimated normals have no outside.
  expect_ok(defray(
      folder_,
      "splat p.xyz -o b.exr --size 48x32 --from 0.95,0.95,-5 --look-at 0.95,0.95,0 " + wide_lens));
  EXPECT_GT(ImageFile::read(folder_ / "b.exr").plane(0, 3)[16 * 48 + 24], 0.95f);
}

TEST_F(SplatCommand, ACacheGivesTheSamePictureUntilItsFileChanges) {
  const auto write = [&](int side) {
    std::ofstream points(folder_ / "p.xyz");
    for (int i = 0; i < side * side; ++i) points << i % side << ' ' << i / side << " 0\n";
    points << "inf 0 0\n";
  };
  const auto notes = [&](const std::string& options) {
    const Result result =
        defray(folder_, "splat p.xyz -o o.exr --size 48x32 " + wide_lens + options);
    expect_ok(result);
    return result.err;
  };
  write(20);
  notes("");
  const std::uint64_t plain = file_hash(folder_ / "o.exr");
  const std::string cache = folder_ / "p.xyz.surfels";
  EXPECT_FALSE(std::filesystem::exists(cache));
  const std::string first = notes("--cache");
  ASSERT_TRUE(std::filesystem::exists(cache));
  const auto time = std::filesystem::last_write_time(cache);
  EXPECT_EQ(notes("--cache"), first) << "notes are kept";
  EXPECT_EQ(file_hash(folder_ / "o.exr"), plain);
  EXPECT_EQ(std::filesystem::last_write_time(cache), time) << "read";
  // Damaged, in its length, its mark and its last node; of another file.
  const auto bytes = std::filesystem::file_size(cache);
  const auto damage = [&](std::streamoff at) {
    std::fstream file(cache, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(at);
    for (int i = 0; i < 4; ++i) file.put('\x7f');
  };
  std::filesystem::resize_file(cache, bytes - 3);
  EXPECT_NE(notes("--cache").find("is damaged: made anew"), std::string::npos);
  damage(0);
  EXPECT_NE(notes("--cache").find("no cache of this version"), std::string::npos);
  const auto notes_bytes = static_cast<std::streamoff>(first.find('\n') + 1 - first.find("1 of"));
  damage(static_cast<std::streamoff>(bytes) - notes_bytes - 4);
  EXPECT_NE(notes("--cache").find("is damaged: made anew"), std::string::npos);
  EXPECT_EQ(file_hash(folder_ / "o.exr"), plain);
  damage(sizeof(char[16]) + 6 * sizeof(std::uint64_t) + 10);  // in the origin, or the first point
  EXPECT_NE(notes("--cache").find("is damaged: made anew"), std::string::npos);
  for (const int tenths : {2, 4, 6, 8, 9}) {  // numbers like others, of points and nodes
    damage(static_cast<std::streamoff>(bytes) * tenths / 10);
    EXPECT_NE(notes("--cache").find("is damaged: made anew"), std::string::npos) << tenths;
  }
  EXPECT_EQ(file_hash(folder_ / "o.exr"), plain);
  write(21);
  EXPECT_NE(notes("--cache").find("was made of an older p.xyz"), std::string::npos);
  EXPECT_NE(file_hash(folder_ / "o.exr"), plain);
}

TEST_F(SplatCommand, APointCloudTooLargeForTheMemoryIsNamed) {
  const auto expect_refused = [&](const std::string& points, const std::string& why) {
    const Result result =
        shell(folder_, "ulimit -v 1500000; " + program() + " splat --model figure --model-points " +
                           points + " -o o.exr " + wide_lens);
    EXPECT_EQ(result.code, 3) << result.err;
    EXPECT_NE(result.err.find("model figure: " + why), std::string::npos) << result.err;
  };
  expect_refused("40000000",
                 "says it has 40000000 points, which need about 15259 MiB of memory; there are "
                 "1464: thin it out, or split it");
  // Less, and more than what else is in the memory leaves of it.
  expect_refused("3500000", "not enough memory for so many points: thin it out, or split it");
}

TEST_F(SplatCommand, MistakesAreNamed) {
  refused("splat -o o.exr " + wide_lens, 2, {"a point cloud is missing"});
  refused("splat a.ply --model figure -o o.exr " + wide_lens, 2, {"--model", "stands instead"});
  refused("splat a.ply --model-points 3 -o o.exr " + wide_lens, 2,
          {"--model-points", "goes with --model"});
  for (const std::string few : {"0", "-4"}) {
    refused("splat --model figure --model-points " + few + " -o o.exr " + wide_lens, 2,
            {"--model-points is " + few + ": allowed are 1 on"});
  }
  std::ofstream(folder_ / "far.xyz") << "0 0 0\n1e20 0 0\n0 1 0\n";
  refused("splat far.xyz -o o.exr " + wide_lens, 3,
          {"far.xyz: point 1 lies 1e+20 0 0 units from the cloud's origin: allowed are 1e+15"});
  refused("splat --model figure --cache -o o.exr " + wide_lens, 2, {"--cache", "goes with a file"});
  refused("splat a.ply -o o.exr " + wide_lens, 3, {"a.ply", "no such file"});
  refused("splat a.ply -o o.exr --layers -1 " + wide_lens, 2, {"--layers is -1"});  // at once
  refused("splat --model figur -o o.exr " + wide_lens, 2,
          {"model 'figur' is not known. Did you mean 'figure'? Allowed: plane figure"});
  refused("splat --model figure --model-points 1000000000000 -o o.exr " + wide_lens, 3,
          {"model figure: says it has 1000000000000 points, which need about 381469727 MiB"});
  refused(figure + "-o o.abc " + wide_lens, 2, {"o.abc"});
  refused(figure + "-o none/o.exr " + wide_lens, 4, {"none"});
  refused(
      figure + "-o o.####.exr " + wide_lens, 2,
      {"o.####.exr: has a frame pattern, and one picture is asked for: --turntable or --frames"});
  refused(figure + wide_lens, 2, {"--output is missing"});
  refused(figure + "-o o.exr --focal-length 50", 2, {"--fstop"});
  refused(figure + "-o o.exr --from 1,2 " + wide_lens, 2, {"--from '1,2'", "1,2.5,-3"});
  refused(figure + "-o o.exr --from 1,2,x " + wide_lens, 2, {"--from '1,2,x'"});
  refused(figure + "-o o.exr --from 1,1,1 --look-at 1,1,1 " + wide_lens, 2,
          {"--from and --look-at are the same place"});
  refused(figure + "-o o.exr --up 0,0,0 " + wide_lens, 2,
          {"--up 0,0,0 is 0, or where", "as 0,1,0 does"});
  refused(figure + "-o o.exr --up 0,0,1 " + wide_lens, 2,
          {"--up 0,0,1 is 0, or where the camera looks"});
  refused("splat --model figure --size 3 -o o.exr " + wide_lens, 2, {"--size '3'", "1920x1080"});
  refused("splat --model figure --size 0x4 -o o.exr " + wide_lens, 2, {"0x4", "1 to 16384"});
  refused(figure + "-o o.exr --cutoff 9 " + wide_lens, 2, {"--cutoff is 9"});
  refused(figure + "-o o.exr --layers -1 " + wide_lens, 2,
          {"--layers is -1: allowed are 1 on, and 0 for all"});
  refused(figure + "-o o.exr --transparency 1 " + wide_lens, 2, {"--transparency is 1"});
  refused(figure + "-o o.exr --psf dics " + wide_lens, 2, {"--psf", "Did you mean 'disc'?"});
  refused(figure + "-o o.exr --turntable 3 " + wide_lens, 2,
          {"o.exr", "3 frames would go to one file"});
  for (const std::string count : {"-1", "0", "1000000000"}) {
    refused(figure + "-o o.####.exr --turntable " + count + " " + wide_lens, 2,
            {"--turntable is " + count + ": allowed are 1 to 100000"});
  }
}

TEST_F(SplatCommand, WithoutAScreenThereIsNothingToShow) {
  const Result result =
      defray(folder_, figure + "-o o.png --show " + wide_lens, "env -u DISPLAY -u WAYLAND_DISPLAY");
  expect_ok(result);
  EXPECT_NE(result.err.find("--show skipped"), std::string::npos) << result.err;
}

TEST_F(SplatCommand, ADeadOutputStaysAsItWas) {
  std::ofstream(folder_ / "o.exr") << "old";
  refused(figure + "-o o.exr --cutoff 9 " + wide_lens, 2, {"--cutoff"});
  EXPECT_EQ(std::filesystem::file_size(folder_ / "o.exr"), 3u);
}

}  // namespace
}  // namespace defray::test::splat_command_test
