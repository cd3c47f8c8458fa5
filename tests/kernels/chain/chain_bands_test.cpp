// The chain in bands of rows: the same bits as the frame at once, whatever the memory, and no more
// memory than it was given.
#include <malloc.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

#include "base/pages.h"
#include "base/random.h"
#include "chain/chain.h"
#include "chain/half_size.h"
#include "chain/plan/ray_plan.h"
#include "chain/steps/behind.h"
#include "support.h"

namespace defray::test::chain_bands_test {
namespace {

/// A wall that slants, bars and a beam before it, lamps, a corner of sky, and zeros of both signs.
struct Shot {
  int width, height, channels = 3;
  bool is_antialiased = false;
  double blur_px = 12;  ///< Of background; near things have more.
  int lamp_every = 1500;
  bool has_wires = false;  ///< Thin ones that go on behind beams of 60 rows.

  float depth_at(int x, int y) const {
    if (x > width * 3 / 4 && y < height / 5) return HUGE_VALF;
    if (has_wires) {
      if (y % 128 >= 40 && y % 128 < 100) return 1.2f;
      return (x + y / 4) % 31 < 4 ? 2.6f : 4.0f;
    }
    if (y >= 60 && y < 66) return 2.95f;
    if (x % 47 >= 20 && x % 47 < 26) return 1.2f;
    if (is_antialiased && x % 47 == 19) return 2.2f;
    return 4 + 0.002f * static_cast<float>(y);
  }

  float colour_at(int x, int y, int channel) const {
    if (is_antialiased && depth_at(x, y) == 2.2f) {  // in the shares of its depth
      const float low = colour_at(x - 1, y, channel), z = depth_at(x - 1, y);
      return low + (2.2f - z) / (1.2f - z) * (colour_at(x + 1, y, channel) - low);
    }
    Random random(x, y, static_cast<std::uint32_t>(channel));
    if (channel == 3) return x / 50 % 3 == 0 ? 0 : 1;
    if (Random(x, y, 9).next() * lamp_every < 1) return 500;
    if (y % 90 == 89) return -0.0f;
    return ((x / 7 + y / 5) % 2 ? 0.7f : 0.2f) + 0.1f * static_cast<float>(random.next());
  }

  Frame frame() const {
    std::vector<std::int32_t> coc;
    Plane depth;
    std::vector<Plane> planes(static_cast<std::size_t>(channels));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double z = depth.emplace_back(depth_at(x, y));
        const double px = std::isinf(z) ? blur_px : blur_px * (z - 3) / z;
        coc.push_back(static_cast<std::int32_t>(std::lround(256 * px)));
        for (int c = 0; c < channels; ++c) {
          planes[static_cast<std::size_t>(c)].push_back(colour_at(x, y, c));
        }
      }
    }
    Frame f{width, height, coc, depth, planes, channels == 4};
    f.origin_x = 5;
    f.origin_y = -3;
    f.display_width = width + 20;
    f.display_height = height + 4;
    return f;
  }
};

/// Memory of the session's stages until this ends.
class Memory {
 public:
  explicit Memory(std::size_t bytes) { session().set_memory(bytes); }
  ~Memory() { session().set_memory(default_memory_bytes); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
};

constexpr std::size_t all_rows = std::size_t{1} << 40, fewest_rows = 1 << 20;

MethodResult rendered(const Frame& f, const ChainSettings& s, std::size_t memory, bool nearest) {
  const Memory given(memory);
  return (s.half_size ? run_half_size : run_chain)(f, s, device(), nearest, {});
}

void expect_same(const MethodResult& a, const MethodResult& b) {
  ASSERT_EQ(a.colour.size(), b.colour.size());
  EXPECT_EQ(hash_of(a.colour), hash_of(b.colour));
  EXPECT_EQ(hash_of({a.confidence, a.tiles.picture()}), hash_of({b.confidence, b.tiles.picture()}));
  EXPECT_EQ(a.nearest, b.nearest);
  EXPECT_EQ(a.report->repaired, b.report->repaired);
  EXPECT_EQ(a.report->behind, b.report->behind);
  EXPECT_EQ(a.report->split, b.report->split);
  EXPECT_EQ(a.report->highlights, b.report->highlights);
  EXPECT_EQ(a.report->interpolated, b.report->interpolated);
  EXPECT_EQ(a.report->border_px, b.report->border_px);
  EXPECT_EQ(a.report->confidence, b.report->confidence);
}

void expect_no_seams(const Shot& shot, const ChainSettings& settings, bool nearest = false) {
  const Frame f = shot.frame();
  const MethodResult whole = rendered(f, settings, all_rows, nearest);
  for (const std::size_t memory : {fewest_rows, 8 * fewest_rows}) {
    expect_same(rendered(f, settings, memory, nearest), whole);
  }
}

std::vector<std::pair<const char*, ChainSettings>> all_settings() {
  std::vector<std::pair<const char*, ChainSettings>> all{{"default", {}}};
  const auto add = [&](const char* name) -> ChainSettings& {
    return all.emplace_back(name, ChainSettings()).second;
  };
  add("hidden off").hidden = Hidden::off;
  add("hidden fill").hidden = Hidden::fill;
  add("split off").split = false;
  add("repair off").repair = false;
  add("highlights off").highlights = false;
  add("soften off").soften = false;
  add("black").border = Border::black;
  add("renormalise").border = Border::renormalise;
  add("cat's eye").aperture.cats_eye = 0.7;
  add("scatter").rays = RaysBy::scatter;
  add("preview") = settings_for(Quality::preview);
  for (auto& [name, s] : all) s.cells_per_side = std::min(s.cells_per_side, 7);
  return all;
}

TEST(ChainBands, NoSeamShowsWhateverTheStages) {
  for (const auto& [name, settings] : all_settings()) {
    SCOPED_TRACE(name);
    expect_no_seams({100, 170}, settings);
  }
}

TEST(ChainBands, NoSeamShowsWhereStagesLookFarBack) {
  ChainSettings settings;
  settings.cells_per_side = 5;
  Shot shot{160, 420};
  shot.blur_px = 40;
  for (const Hidden hidden : {Hidden::fill, Hidden::patterns}) {
    settings.hidden = hidden;
    expect_no_seams(shot, settings);
  }
}

TEST(ChainBands, NoSeamShowsWhereStripsGoOn) {
  ChainSettings settings;
  settings.cells_per_side = 5;
  Shot shot{100, 420};
  shot.has_wires = true;
  for (const Hidden hidden : {Hidden::fill, Hidden::patterns}) {
    settings.hidden = hidden;
    expect_no_seams(shot, settings);
  }
}

TEST(ChainBands, NoSeamShowsWhateverTheFrame) {
  ChainSettings settings;
  settings.cells_per_side = 7;
  Shot shot{100, 170};
  shot.channels = 4;
  shot.is_antialiased = true;
  expect_no_seams(shot, settings, true);
  EXPECT_GT(rendered(shot.frame(), settings, all_rows, true).report->repaired, 100u);
  shot.channels = 1;
  expect_no_seams(shot, settings, true);
  shot.blur_px = 60;  // beyond several bands
  expect_no_seams(shot, settings);
  shot.lamp_every = 16000;  // bands without one
  shot.blur_px = 4;
  shot.height = 400;
  expect_no_seams(shot, settings);
}

TEST(ChainBands, NoSeamShowsWhereDevicesAllowSmallBuffersAlone) {
  DeviceInfo info = device_under_test();
  info.max_buffer_bytes = 1200 << 10;  // the aperture's table takes 1 MiB
  Session small(info);
  DeviceBackend backend(small);
  ChainSettings settings;
  settings.cells_per_side = 5;
  const Frame f = Shot{250, 600, 3, true, 3}.frame();  // a plane of two layers does not fit
  expect_same(run_chain(f, settings, backend), rendered(f, settings, all_rows, false));
}

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

TEST(ChainBands, PlanesAreGivenBackBeforeAFrameIsCut) {
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
  return hash_of_planes(behind.frame.channels);
}

TEST(ChainBands, LargeFramesAreSearchedInTheSameStrips) {
  const Frame f = Shot{120, 420}.frame();
  EXPECT_EQ(behind_by_strips(f, fewest_rows), behind_by_strips(f, all_rows));
}

TEST(ChainBands, StripsLieEvenlyInLargePicturesAlone) {
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

TEST(ChainBands, PagesGivenBackAreThoseWhollyWithin) {
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

TEST(ChainBands, TakeNoMoreMemoryThanTheyWereGiven) {
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
}  // namespace defray::test::chain_bands_test
