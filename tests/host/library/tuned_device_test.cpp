// Work-groups that `defray tune` found, as a program meets them: used by themselves, the same bits.
#include <cstdlib>
#include <fstream>

#include "defray/defray.h"
#include "support.h"
#include "tuning/shapes.h"
#include "tuning/tuning_file.h"

namespace defray::test::tuned_device_test {
namespace {

using tuning::Validity;

/// A cache folder of its own, with these results for the device.
class Tuned : public testing::Test {
 protected:
  Folder folder;
  std::optional<std::string> before;
  std::string path;
  const Plane colour = random_plane({48, 32}, 1), depth = random_depth({48, 32}, 2);

  void SetUp() override {
    if (const char* cache = std::getenv("XDG_CACHE_HOME")) before = cache;
    setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
    path = tuning::path_of(tuning::key_of(device_under_test()));
  }
  void TearDown() override {
    before ? setenv("XDG_CACHE_HOME", before->c_str(), 1) : unsetenv("XDG_CACHE_HOME");
  }

  void keep(const std::string& frame_class, const std::string& kernel, tuning::Shape shape) const {
    const tuning::Place place{frame_class, "a picture", kernel};
    tuning::add(path, tuning::key_of(device_under_test()), device_under_test().max_work_group,
                {{place,
                  tuning::own_shape(kernel, device_under_test().is_gpu()),
                  Validity::correct,
                  {9, 9, 9, 9, 9}},
                 {place, shape, Validity::correct, {5, 5, 5, 5, 5}}});
  }

  Device open(bool use_tuning = true) const {
    const DeviceInfo info = device_under_test();
    return Device::open(info.name, {Math::strict, use_tuning, true});
  }

  RenderResult picture(Device& device, double aperture_mm = 100,
                       const Options& options = {}) const {
    Picture p;
    p.data = {0, 0, 48, 32};
    p.colour = {colour, colour, colour};
    p.depth = depth;
    Lens lens;
    lens.focus_distance_units = 3;
    lens.aperture_diameter_mm = aperture_mm;
    return render(device, p, lens, options);
  }
};

using Names = std::vector<std::string>;

TEST_F(Tuned, ABudgetChoosesTheQuality) {
  Device device = open();
  Options options;
  options.budget_ms = 60000;
  options.error.wants_expected = true;
  const RenderResult rich = picture(device, 100, options);
  ASSERT_TRUE(rich.report.budget);
  EXPECT_EQ(rich.report.budget->quality, Quality::high);
  EXPECT_EQ(rich.report.budget->cells_per_side, 33);
  EXPECT_EQ(rich.report.budget->budget_ms, 60000);
  Options by_hand;
  by_hand.chain = settings_for(Quality::high);
  EXPECT_EQ(picture(device, 100, by_hand).colour, rich.colour);
  // It learns, and keeps that for other processes.
  EXPECT_NE(picture(device, 100, options).report.budget->expected_ms,
            rich.report.budget->expected_ms);
  Device another = open();
  EXPECT_NE(picture(another, 100, options).report.budget->expected_ms,
            rich.report.budget->expected_ms);
  const auto refuses = [&](const std::vector<std::string>& words, const auto& change) {
    Options changed = options;
    change(changed);
    expect_error(ErrorKind::usage, words, [&] { picture(device, 100, changed); });
  };
  refuses({"budget_ms", "above 0"}, [](Options& o) { o.budget_ms = -1; });
  refuses({"budget_ms", "target_db"}, [](Options& o) { o.error.target_db = 40; });
  refuses({"budget_ms", "stages alone"}, [](Options& o) { o.chain.reset(), o.error = {}; });
}

TEST_F(Tuned, WorkGroupsAreUsedAndToldAndGiveTheSameBits) {
  Device plain = open();
  const RenderResult expected = picture(plain);
  EXPECT_EQ(expected.report.tuned, Names());
  keep("small narrow", "fill", {2, 2});
  keep("small narrow", "rdb_gather", {1, 2});
  keep("small wide", "split", {2, 1});
  keep("hd narrow", "coc", {2, 1});
  Device device = open();
  const RenderResult result = picture(device);
  EXPECT_EQ(result.report.tuned, (Names{"fill=2x2", "rdb_gather=1x2"}));
  EXPECT_EQ(result.colour, expected.colour);
  EXPECT_EQ(picture(device, 1e4).report.tuned, (Names{"split=2x1"}));
  EXPECT_EQ(picture(device).report.tuned, (Names{"fill=2x2", "rdb_gather=1x2"}));
}

TEST_F(Tuned, WhatTheUserSetsWins) {
  keep("small narrow", "fill", {2, 2});
  Device device = open();
  device.set_work_group("fill", 4, 1);
  EXPECT_EQ(picture(device).report.tuned, Names());
  device.set_work_group("fill", 0, 0);
  EXPECT_EQ(picture(device).report.tuned, Names{"fill=2x2"});
  Device untuned = open(false);
  EXPECT_EQ(picture(untuned).report.tuned, Names());
}

TEST_F(Tuned, PointCloudsAreAClassOfTheirOwn) {
  keep("small cloud", "splat_resolve", {2, 2});
  Device device = open();
  const SplatModel model(make_point_cloud("plane", 400));
  SplatSettings settings;
  settings.width = settings.height = 32;
  Lens lens;
  lens.focus_distance_units = 1;
  const CameraPose pose = framing_pose(model, lens, settings);
  const SplatResult result = splat(device, model, pose, lens, settings);
  EXPECT_EQ(result.report.tuned, Names{"splat_resolve=2x2"});
  Device plain = open(false);
  EXPECT_EQ(splat(plain, model, pose, lens, settings).colour, result.colour);
}

TEST_F(Tuned, ADamagedFileIsANote) {
  keep("small narrow", "fill", {2, 2});
  EXPECT_EQ(open().notes(), Names());
  std::ofstream(path) << "{";
  Device device = open();
  ASSERT_EQ(device.notes().size(), 1u);
  EXPECT_NE(device.notes()[0].find("is damaged and not used"), std::string::npos);
  EXPECT_EQ(picture(device).report.tuned, Names());
  EXPECT_EQ(open(false).notes(), Names());
}

TEST_F(Tuned, KernelsTimesAreThoseSinceTheLastCall) {
  Device device = open();
  EXPECT_TRUE(device.take_kernel_seconds().empty());
  picture(device);
  const auto seconds = device.take_kernel_seconds();
  EXPECT_GT(seconds.at("rdb_gather"), 0);
  EXPECT_GT(seconds.at("coc"), 0);
  EXPECT_TRUE(device.take_kernel_seconds().empty());
  Device reference = Device::reference();
  expect_error(ErrorKind::usage, {"measures", "reference"},
               [&] { reference.take_kernel_seconds(); });
  expect_error(ErrorKind::usage, {"properties", "reference"}, [&] { reference.properties(); });
  EXPECT_EQ(device.properties().name, device_under_test().name);
}

}  // namespace
}  // namespace defray::test::tuned_device_test
