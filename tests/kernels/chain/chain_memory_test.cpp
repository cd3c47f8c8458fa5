// The chain's memory: what it cuts a frame into, gives back, and takes at most.
#include <malloc.h>

#include <algorithm>
#include <fstream>

#include "banded_shot.h"
#include "base/pages.h"
#include "chain/plan/ray_plan.h"
#include "chain/steps/behind.h"

namespace defray::test::chain_memory_test {
namespace {

/// How `run_chain` goes through a frame with so much memory, and what it counts as planes' bytes.
struct Bands : ChainBands {
  Bands(const Frame& f, const ChainSettings& s, std::size_t memory) {
    ChainWork work(s, device());
    work.plan = ray_plan(s, false);
    work.reach = chain_reach(f, s, 137);
    const Front front(f, work);
    const PlaneCounts planes{f.channels.size(), f.has_alpha, false};
    static_cast<ChainBands&>(*this) = chain_bands(front.frame, planes, work.reach, memory);
    bytes = bytes_of_bands(front.frame, planes, work.reach, *this);
  }
  std::size_t bytes = 0;
};

TEST(ChainMemory, PlanesAreGivenBackBeforeAFrameIsCut) {
  const Frame f = Shot{100, 170}.frame();
  ChainSettings settings;
  settings.cells_per_side = 7;
  const Bands kept(f, settings, all_rows);
  EXPECT_FALSE(kept.gives_back);
  const Bands given_back(f, settings, kept.bytes - 1);
  EXPECT_TRUE(given_back.gives_back);
  EXPECT_EQ(given_back.rows, kept.rows);
  EXPECT_LT(given_back.bytes, kept.bytes);
  const Bands cut(f, settings, given_back.bytes - 1);
  EXPECT_LT(cut.rows, kept.rows);
  if (!session().works_in_host_memory()) return;
  const MethodResult whole = rendered(f, settings, all_rows, false);
  for (const Bands& b : {given_back, cut}) {
    expect_same(rendered(f, settings, b.bytes, false), whole);
  }
}

/// All that `patterns` gives behind a frame that is searched in strips.
std::uint64_t behind_by_strips(const Frame& f, std::size_t memory) {
  const Memory given(memory);
  ChainSettings settings;
  ChainWork work(settings, device());
  work.plan = ray_plan(settings, false);
  work.reach = chain_reach(f, settings, 137);
  Front front(f, work);
  work.bands = chain_bands(front.frame, {}, work.reach, device().memory_for_planes());
  work.is_banded = work.bands.rows < front.frame.height;
  // Planes of a device with memory of its own take other memory than that.
  if (session().works_in_host_memory()) {
    EXPECT_EQ(work.is_banded, memory < all_rows);
  }
  PatternSettings strips;
  strips.most_searched = 1000;
  strips.strips = 2;
  strips.strip_rows = 100;
  front.look_at_all();
  Behind behind(front, work, strips);
  behind.look_at_all();
  behind.to(front.frame.height);
  return hash_of_planes(behind.frame().channels);
}

TEST(ChainMemory, LargeFramesAreSearchedInTheSameStrips) {
  const Frame f = Shot{120, 420}.frame();
  EXPECT_EQ(behind_by_strips(f, fewest_rows), behind_by_strips(f, all_rows));
}

TEST(ChainMemory, StripsLieEvenlyInLargePicturesAlone) {
  const PatternSettings s;
  EXPECT_EQ(pattern_strips(4096, 2304, s).size(), 1u);
  EXPECT_EQ(pattern_strips(60000, 768, s).size(), 1u);
  const std::vector<Rows> strips = pattern_strips(16384, 8192, s);
  ASSERT_EQ(strips.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(strips[k].count(), 256);
    const double middle = (strips[k].y + strips[k].end) / 2.0;
    EXPECT_NEAR(middle, 8192 * (static_cast<double>(k) + 0.5) / 3, 2);
  }
}

TEST(ChainMemory, PagesGivenBackAreThoseWhollyWithin) {
  std::vector<char> bytes(64 << 12, 1);
  give_back_pages(bytes.data() + 1, bytes.size() - 2);
  EXPECT_EQ(bytes.front(), 1);
  EXPECT_EQ(bytes.back(), 1);
  EXPECT_EQ(bytes[bytes.size() / 2], 0);
  EXPECT_GE(std::count(bytes.begin(), bytes.end(), 1), 2);
  EXPECT_LE(std::count(bytes.begin(), bytes.end(), 1), 2 << 12);
}

/// Of /proc/self/status, bytes; 0 where there is none.
std::size_t memory_now(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != key + ":") continue;
    std::size_t kib = 0;
    status >> kib;
    return kib << 10;
  }
  return 0;
}

/// What a render takes at most beyond what there was.
std::size_t peak_of(const Frame& f, const ChainSettings& settings, std::size_t memory) {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak so far is forgotten
  const std::size_t before = memory_now("VmRSS");
  rendered(f, settings, memory, false);
  return memory_now("VmHWM") - before;
}

TEST(ChainMemory, IsNoMoreThanWasGiven) {
  SKIP_UNLESS_FULL();
  if (!session().works_in_host_memory() || memory_now("VmHWM") == 0) GTEST_SKIP();
  const Frame f = Shot{1200, 2400, 3, false, 3}.frame();
  ChainSettings settings;
  settings.cells_per_side = 5;
  settings.hidden = Hidden::fill;
  peak_of(f, settings, fewest_rows);  // what is made once
  const std::size_t result = f.pixels() * 4 * sizeof(float), given = std::size_t{64} << 20;
  EXPECT_LT(peak_of(f, settings, given), result + given);
  EXPECT_GT(peak_of(f, settings, all_rows), result + 4 * given);
  const Bands kept(f, settings, all_rows), given_back(f, settings, kept.bytes - 1);
  EXPECT_LT(peak_of(f, settings, kept.bytes - 1), (kept.bytes + given_back.bytes) / 2);
}

}  // namespace
}  // namespace defray::test::chain_memory_test
