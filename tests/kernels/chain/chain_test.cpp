// The chain's report: every stage by its name, in the order they end, with its own time.
#include "chain/chain.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/stopwatch.h"
#include "chain/plan/ray_plan.h"
#include "rdb/rdb.h"
#include "reference/twin_backend.h"
#include "support.h"

namespace defray::test::chain_test {
namespace {

constexpr double delay_s = 0.1;
void be_late() { std::this_thread::sleep_for(std::chrono::duration<double>(delay_s)); }

/// The twins, one of them late.
class LateBackend : public reference::TwinBackend {
 public:
  explicit LateBackend(std::string late) : late_(std::move(late)) {}

  Words repair(const Frame& f, Words w) override {
    return wait("repair"), TwinBackend::repair(f, std::move(w));
  }
  Words mixed(const Frame& f, Words w) override {
    return wait("mixed"), TwinBackend::mixed(f, std::move(w));
  }
  Frame fill(const Frame& f, const Words& m, int n, Frame i) override {
    return wait("fill"), TwinBackend::fill(f, m, n, std::move(i));
  }
  Planes feather(const Frame& b, const Quanta& q, const Words& m, const Words& s,
                 Planes i) override {
    return wait("feather"), TwinBackend::feather(b, q, m, s, std::move(i));
  }
  Frame split(const Frame& f, const Words& m, const Frame& b, Frame i) override {
    return wait("split"), TwinBackend::split(f, m, b, std::move(i));
  }
  Values<float> highlights(const Frame& f, int n, Values<float> i) override {
    return wait("highlights"), TwinBackend::highlights(f, n, std::move(i));
  }
  Planes soften(const Frame& f, int n, Planes i) override {
    return wait("soften"), TwinBackend::soften(f, n, std::move(i));
  }
  RayResult rays(const Frame& f, const RayPlan& plan, const LightSources* lights,
                 const Progress& progress) override {
    return wait("rays"), TwinBackend::rays(f, plan, lights, progress);
  }
  Frame patterns(const Frame& f, Frame b, const Words& w, const Values<float>& v,
                 const std::vector<PatternShift>& s, const PatternSettings& p) override {
    return wait("patterns"), TwinBackend::patterns(f, std::move(b), w, v, s, p);
  }

 private:
  void wait(const char* stage) const {
    if (stage == late_) be_late();
  }
  std::string late_;
};

/// Colours that are late where the host looks at them first.
class LatePlane : public DeviceValues {
 public:
  explicit LatePlane(const Values<float>& plane) : plane_(plane.begin(), plane.end()) {}
  void fetch(void* host) override {
    be_late();
    std::copy(plane_.begin(), plane_.end(), static_cast<float*>(host));
  }

 private:
  std::vector<float> plane_;
};

/// Twins after whose stages the chain itself is the first to look at colours: to go on with them in
/// the margin.
class LateMargin : public reference::TwinBackend {
 public:
  Frame split(const Frame& f, const Words& m, const Frame& b, Frame i) override {
    Frame layers = TwinBackend::split(f, m, b, std::move(i));
    Values<float>& red = layers.channels[0];
    red = Values<float>::on(std::make_unique<LatePlane>(red), red.size());
    return layers;
  }
  Values<float> highlights(const Frame& f, int, Values<float>) override {
    return Values<float>(f.surfaces(), 1.0f);  // none
  }
};

/// Stripes behind a bar before the plane of focus, a lamp on them.
MethodResult rendered(Backend& backend) {
  constexpr int width = 64, height = 40;
  std::vector<std::int32_t> coc(width * height, 4 * 256);
  Plane depth(coc.size(), 5), colour(coc.size());
  for (std::size_t i = 0; i < coc.size(); ++i) {
    const std::size_t x = i % width;
    colour[i] = x % 6 < 3 ? 0.2f : 0.7f;
    if (x >= 28 && x < 36) coc[i] = -6 * 256, depth[i] = 1, colour[i] = 0.4f;
  }
  colour[20 * width + 10] = 3000;
  return run_chain({width, height, coc, depth, {colour, colour, colour}}, ChainSettings{}, backend);
}

double seconds_of(const MethodResult& result, const std::string& stage) {
  double seconds = 0;
  for (const StageTime& s : result.report->stages) seconds += s.stage == stage ? s.seconds : 0;
  return seconds;
}

TEST(Chain, ReportsItsStagesByName) {
  reference::TwinBackend twins;
  const MethodResult result = rendered(twins);
  std::vector<std::string> names;
  for (const StageTime& s : result.report->stages) {
    names.push_back(s.stage);
    EXPECT_GE(s.seconds, 0) << s.stage;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"lens", "border", "mixed", "repair", "silhouettes",
                                             "fill", "patterns", "feather", "split", "tiles",
                                             "highlights", "soften", "rays", "crop"}));
  EXPECT_EQ(result.report->highlights, 1u);
  EXPECT_EQ(result.report->lens_points, 137);
  EXPECT_GT(result.report->behind, 0u);
}

TEST(Chain, GivesEachStageItsOwnTime) {
  reference::TwinBackend twins;
  for (const std::string late : {"mixed", "repair", "fill", "patterns", "feather", "split",
                                 "highlights", "soften", "rays"}) {
    LateBackend backend(late);
    const MethodResult result = rendered(backend);
    for (const StageTime& s : result.report->stages) {
      if (s.stage == late) {
        EXPECT_GE(s.seconds, delay_s) << late;
      }
    }
    EXPECT_GE(seconds_of(result, late), delay_s) << late;
  }
}

TEST(Chain, GivesBorderTheTimeOfColoursInTheMargin) {
  LateMargin backend;
  EXPECT_GE(seconds_of(rendered(backend), "border"), delay_s);
}

TEST(Chain, GivesLensTheTimeOfItsPoints) {
  ChainSettings settings;
  settings.cells_per_side = 64;
  settings.aperture.blades = 5;
  double alone = HUGE_VAL;
  for (int i = 0; i < 5; ++i) {
    const Stopwatch watch;
    ray_plan(settings, false);
    alone = std::min(alone, watch.seconds());
  }
  reference::TwinBackend twins;
  const std::vector<std::int32_t> in_focus(6);
  const Plane plane(6, 1.0f);
  const MethodResult result = run_chain({3, 2, in_focus, plane, {plane}}, settings, twins);
  EXPECT_GE(seconds_of(result, "lens"), alone / 2);
}

/// A bar in front of a wall; in `ramps` of its rows its left edge's depth lies between both, and so
/// does its colour, or it has one of its own.
struct Bar {
  static constexpr int width = 40, height = 60;
  std::vector<std::int32_t> coc = std::vector<std::int32_t>(width * height, 512);
  Plane depth = Plane(width * height, 4), colour = Plane(width * height, 0.8f);

  explicit Bar(int ramps, float between = 0.4f) {
    for (int y = 10; y < 50; ++y) {
      for (int x = 14; x < 26; ++x) {
        const auto i = static_cast<std::size_t>(y * width + x);
        const bool is_between = x == 14 && y >= 12 && y < 12 + ramps;
        coc[i] = (is_between ? -3 : -8) * 256;
        depth[i] = is_between ? 2 : 1;
        colour[i] = is_between ? between : 0.2f;
      }
    }
  }
  Frame frame() const {
    Frame f{width, height, coc, depth, {colour}};
    return f;
  }
};

/// Depth counts as anti-aliased where one in 20 edge pixels lies between two surfaces.
TEST(Chain, RepairsDepthWhereOneEdgePixelIn20IsBetween) {
  int repaired_often = 0, left_often = 0;
  for (int ramps = 0; ramps <= 36; ramps += 2) {
    const Bar bar(ramps);
    const Words mixed = device().mixed(bar.frame()), said = device().repair(bar.frame());
    std::size_t between = 0, edge = 0;
    for (std::size_t i = 0; i < said.size(); ++i) between += said[i] != 0, edge += mixed[i];
    for (const Border border : {Border::renormalise, Border::clamp}) {
      ChainSettings settings;
      settings.border = border;
      const auto report = run_chain(bar.frame(), settings, device()).report;
      const bool is_repaired = between > 0 && between * 20 >= edge;
      EXPECT_EQ(report->repaired, is_repaired ? between : 0)
          << ramps << ": " << between << " of " << edge;
      const Bar rim(ramps, 0.9f);
      EXPECT_EQ(run_chain(rim.frame(), settings, device()).report->repaired, 0u) << ramps;
      (is_repaired ? repaired_often : left_often) += 1;
    }
  }
  EXPECT_GT(repaired_often, 4);
  EXPECT_GT(left_often, 4);
}

/// A pixel between two surfaces gets one's depth, and with it that one's data: its own are
/// nobody's.
TEST(Chain, RepairedPixelsLendNoData) {
  Bar bar(36);
  for (std::int32_t& coc : bar.coc) coc += 8 * 256;  // the bar in focus hides nothing beside it
  const Words said = device().repair(bar.frame());
  const auto data_from_between = [&](bool repairs) {
    ChainSettings settings;
    settings.repair = repairs;
    std::size_t count = 0;
    for (const std::uint32_t i : run_chain(bar.frame(), settings, device(), true).nearest) {
      count += said[i] != 0;
    }
    return count;
  };
  EXPECT_EQ(data_from_between(true), 0u);
  EXPECT_GT(data_from_between(false), 0u);
}

TEST(Chain, LeavesDepthAloneWhereAskedTo) {
  ChainSettings settings;
  settings.repair = false;
  EXPECT_EQ(run_chain(Bar(36).frame(), settings, device()).report->repaired, 0u);
}

}  // namespace
}  // namespace defray::test::chain_test
