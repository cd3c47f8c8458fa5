// The chain in bands of rows: the same bits as the frame at once, whatever the memory.
#include "banded_shot.h"

namespace defray::test::chain_bands_test {
namespace {

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

}  // namespace
}  // namespace defray::test::chain_bands_test
