// Stages of whole pictures, one by one: each is given what the device made before it, and gives the
// bits of its twin. Tells which stage it is where a picture of a device is not that of others.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "rdb/rdb.h"
#include "reference/twin_backend.h"
#include "scenes/subject.h"
#include "support.h"

namespace defray::test::chain_stages_test {
namespace {

/// Values of the wanted rows of a frame: the first that differ are told.
template <typename A, typename B>
void expect_bits(const char* stage, const Frame& f, const A& made, const B& twins) {
  ASSERT_EQ(made.size(), twins.size()) << stage;
  if (made.size() == 0) return;  // not one of the stage's planes
  const Rows rows = f.wanted_rows();
  std::size_t differing = 0;
  for (std::size_t i = f.index(0, rows.y); i < f.index(0, rows.end); ++i) {
    const auto is = std::bit_cast<std::uint32_t>(made[i]);
    const auto twin = std::bit_cast<std::uint32_t>(twins[i]);
    if (is == twin || ++differing > 3) continue;
    const std::size_t row = i / size(f.width);
    ADD_FAILURE() << stage << ", x " << i % size(f.width) << ", y " << row / size(f.layers)
                  << ", layer " << row % size(f.layers) << ": " << made[i] << " is " << twins[i];
  }
  EXPECT_EQ(differing, 0u) << stage << ", of " << made.size();
}

void expect_planes(const char* stage, const Frame& f, const Planes& made, const Planes& twins) {
  ASSERT_EQ(made.size(), twins.size()) << stage;
  for (std::size_t c = 0; c < made.size(); ++c) {
    expect_bits(stage, f, made[c].host(), twins[c].host());
  }
}

void expect_frames(const char* stage, const Frame& made, const Frame& twins, Rows wanted) {
  Frame rows = made.without_planes();
  rows.wanted = wanted;
  expect_bits(stage, rows, made.coc_quanta.host(), twins.coc_quanta.host());
  expect_bits(stage, rows, made.inverse.host(), twins.inverse.host());
  expect_bits(stage, rows, made.depth.host(), twins.depth.host());
  expect_bits(stage, rows, made.coverage.host(), twins.coverage.host());
  expect_planes(stage, rows, made.channels, twins.channels);
}

/// A frame that another stage does not change.
Frame copied(Frame f) {
  for (Values<float>& channel : f.channels) {
    channel = Values<float>(std::vector<float>(channel.begin(), channel.end()));
  }
  return f;
}

class WatchedStages : public DeviceBackend {
 public:
  using DeviceBackend::DeviceBackend;

  Words mixed(const Frame& f, Words into) override {
    Words made = DeviceBackend::mixed(f, std::move(into));
    expect_bits("mixed", f, made.host(), twins_.mixed(f).host());
    return made;
  }
  Frame fill(const Frame& f, const Words& marks, int directions, Frame into) override {
    Frame made = DeviceBackend::fill(f, marks, directions, std::move(into));
    expect_frames("fill", made, twins_.fill(f, marks, directions), f.wanted_rows());
    return made;
  }
  Frame patterns(const Frame& f, Frame behind, const Words& pixels, const Values<float>& variance,
                 const std::vector<PatternShift>& shifts, const PatternSettings& s) override {
    const Frame twin = twins_.patterns(f, copied(behind), pixels, variance, shifts, s);
    Frame made = DeviceBackend::patterns(f, std::move(behind), pixels, variance, shifts, s);
    expect_frames("patterns", made, twin, f.wanted_rows());
    return made;
  }
  Planes feather(const Frame& behind, const Quanta& seen, const Words& marks, const Words& strips,
                 Planes into) override {
    Planes made = DeviceBackend::feather(behind, seen, marks, strips, std::move(into));
    expect_planes("feather", behind, made, twins_.feather(behind, seen, marks, strips));
    return made;
  }
  Frame split(const Frame& f, const Words& mixed, const Frame& behind, Frame into) override {
    Frame made = DeviceBackend::split(f, mixed, behind, std::move(into));
    expect_frames("split", made, twins_.split(f, mixed, behind), f.wanted_rows());
    return made;
  }
  Values<float> highlights(const Frame& f, int light_channels, Values<float> into) override {
    Values<float> made = DeviceBackend::highlights(f, light_channels, std::move(into));
    expect_bits("highlights", f, made.host(), twins_.highlights(f, light_channels).host());
    return made;
  }
  Planes soften(const Frame& f, int lens_points, Planes into) override {
    Planes made = DeviceBackend::soften(f, lens_points, std::move(into));
    expect_planes("soften", f, made, twins_.soften(f, lens_points));
    return made;
  }
  RayResult rays(const Frame& f, const RayPlan& plan, const LightSources* lights,
                 const Progress& progress) override {
    RayResult made = DeviceBackend::rays(f, plan, lights, progress);
    const RayResult twin = twins_.rays(f, plan, lights);
    Frame rows = f.without_planes();
    rows.layers = 1;
    // Planes of the wanted rows alone; nobody needs those of the margin.
    const Rows wanted = f.wanted_rows();
    rows.height = wanted.count();
    rows.wanted = Rows{std::max(wanted.y, f.margin) - wanted.y,
                       std::min(wanted.end, f.height - f.margin) - wanted.y};
    for (std::size_t c = 0; c < made.means.size(); ++c) {
      expect_bits("rays", rows, made.means[c], twin.means[c]);
    }
    ++pictures;
    return made;
  }

  int pictures = 0;  ///< Whose rays were compared.

 private:
  reference::TwinBackend twins_;
};

class ChainStages : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(ChainStages, OfAPictureEqualTheirTwins) {
  const auto [scene, setting] = GetParam();
  const auto expect_twins = [&, scene = scene, setting = setting] {
    Subject s = make_subject(device(), make_scene(scene, 96, 72), setting);
    s.pinhole.colour = render_pinhole(s.scene, {64}).colour;
    MethodSettings whole;
    whole.chain = ChainSettings{};
    WatchedStages stages(session());
    render(stages, s, whole);
    EXPECT_GT(stages.pictures, 0);
  };
  expect_twins();
  const InBands copies(session(), default_memory_bytes);  // as with memory of their own
  expect_twins();
}

// Lamps behind grass and posts, thin things that go on.
INSTANTIATE_TEST_SUITE_P(Scenes, ChainStages,
                         testing::Values(std::pair{"garden", "grass"}, std::pair{"garden", "post"},
                                         std::pair{"lines", "default"}),
                         [](const auto& info) {
                           return std::string(info.param.first) + "_" + info.param.second;
                         });

}  // namespace
}  // namespace defray::test::chain_stages_test
