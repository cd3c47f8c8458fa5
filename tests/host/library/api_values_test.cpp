// The API's structures as they are before anyone fills them in: settings as their headers say,
// reports of nothing.
#include <cmath>

#include "defray/defray.h"
#include "frame/frame.h"
#include "support.h"

namespace defray::test::api_values_test {
namespace {

TEST(ApiValues, SettingsAreTheDocumentedOnes) {
  const Options o;
  EXPECT_EQ(o.method, Method::rdb);
  ASSERT_TRUE(o.chain);
  EXPECT_EQ(o.chain->cells_per_side, 13);
  EXPECT_EQ(o.chain->pattern_shifts, 24);
  EXPECT_EQ(o.chain->hidden, Hidden::patterns);
  EXPECT_EQ(o.chain->border, Border::clamp);
  EXPECT_EQ(o.chain->rays, RaysBy::gather);
  EXPECT_TRUE(o.chain->split && o.chain->repair && o.chain->highlights && o.chain->soften);
  EXPECT_FALSE(o.chain->half_size || o.wants_nearest);
  EXPECT_EQ(o.rdb.cells_per_side, 9);
  EXPECT_EQ(o.rdb.seed, 0u);
  EXPECT_FALSE(o.rdb.jitter);
  EXPECT_EQ(o.gather.kind, GatherKind::aware);
  EXPECT_EQ(o.gather.samples, 32);
  EXPECT_EQ(o.gather.passes, 2);
  EXPECT_EQ(o.gather.seed, 0u);
  EXPECT_FALSE(o.gather.rotate);
  EXPECT_EQ(o.tiltshift.band_centre, 0.5);
  EXPECT_EQ(o.tiltshift.band_width, 0.2);
  EXPECT_EQ(o.tiltshift.max_blur_px, 9.2);
  EXPECT_EQ(o.depth.kind, DepthKind::z);
  EXPECT_EQ(o.depth.near_units, 0);
  EXPECT_EQ(o.depth.far_units, 0);
  EXPECT_FALSE(o.depth.invert || o.depth.background);
  EXPECT_EQ(o.nonfinite, Nonfinite::zero);
}

TEST(ApiValues, EachMethodHasItsNameAndAllButTiltshiftALens) {
  std::vector<std::string> names;
  for (const Method method : all_methods()) {
    names.push_back(to_string(method));
    EXPECT_EQ(has_lens(method), method != Method::tiltshift) << names.back();
  }
  EXPECT_EQ(names, (std::vector<std::string>{"rdb", "linear", "gather", "tiltshift"}));
}

TEST(ApiValues, QualitiesTradeLensPointsPatternsAndPixelsForTime) {
  struct Row {
    Quality quality;
    int cells;
    Hidden hidden;
    int shifts;
    bool half_size;
  };
  for (const Row& row : {Row{Quality::preview, 6, Hidden::fill, 24, true},
                         Row{Quality::draft, 9, Hidden::fill, 24, false},
                         Row{Quality::normal, 13, Hidden::patterns, 24, false},
                         Row{Quality::high, 33, Hidden::patterns, 48, false}}) {
    const ChainSettings s = settings_for(row.quality);
    EXPECT_EQ(s.cells_per_side, row.cells);
    EXPECT_EQ(s.hidden, row.hidden);
    EXPECT_EQ(s.pattern_shifts, row.shifts);
    EXPECT_EQ(s.half_size, row.half_size);
    EXPECT_TRUE(s.split && s.repair && s.highlights && s.soften);
  }
}

TEST(ApiValues, TheLensIsANormalOneOfF28) {
  const Lens lens;
  EXPECT_EQ(lens.focal_length_mm, 50);
  EXPECT_DOUBLE_EQ(lens.focal_length_mm / lens.aperture_diameter_mm, 2.8);
  EXPECT_EQ(lens.sensor_width_mm, 36);
  EXPECT_EQ(lens.metres_per_unit, 1);
  for (const double none : {lens.pixels_per_metre, lens.focus_distance_units, lens.max_coc_px}) {
    EXPECT_EQ(none, 0);
  }
  EXPECT_EQ(lens.model, LensModel::cg);
  const Aperture round;
  for (const double none :
       {round.curvature, round.rotation_deg, round.cats_eye, round.blades + 0.0}) {
    EXPECT_EQ(none, 0);
  }
  EXPECT_EQ(round.squeeze, 1);
}

TEST(ApiValues, ReportsAndDevicesAreOfNothing) {
  const FrameReport r;
  for (const std::size_t count : {r.depth.background, r.depth.not_a_number, r.depth.outside_range,
                                  r.coc_limited, r.nonfinite}) {
    EXPECT_EQ(count, 0u);
  }
  for (const double value :
       {r.depth.nearest_units, r.depth.farthest_units, r.nearest_coc_px, r.farthest_coc_px,
        r.read_seconds, r.render_seconds, r.write_seconds}) {
    EXPECT_EQ(value, 0);
  }
  EXPECT_EQ(r.data, Window());
  EXPECT_EQ(r.data.x, 0);
  EXPECT_EQ(r.data.y, 0);
  EXPECT_EQ(r.data.width, 0);
  EXPECT_EQ(r.data.height, 0);
  const ChainReport c;
  for (const std::size_t count : {c.repaired, c.behind, c.split, c.highlights, c.tiles.tiles,
                                  size(c.border_px), size(c.lens_points)}) {
    EXPECT_EQ(count, 0u);
  }
  for (const double share : {c.confidence, c.tiles.in_focus, c.tiles.smooth, c.tiles.mixed,
                             c.tiles.hidden, c.tiles.lights}) {
    EXPECT_EQ(share, 0);
  }
  EXPECT_FALSE(c.border_is_cut);
  const DeviceProperties d;
  for (const std::size_t count : {d.compute_units, d.max_work_group, d.global_memory_bytes,
                                  d.local_memory_bytes, d.max_buffer_bytes}) {
    EXPECT_EQ(count, 0u);
  }
  EXPECT_FALSE(d.has_int64_atomics || d.has_double || d.rounds_divisions || d.keeps_denormals ||
               d.shares_host_memory);
  EXPECT_EQ(StageTime{}.bytes, 0u);
  EXPECT_EQ(default_memory_bytes, std::size_t{512} * 1024 * 1024);
}

TEST(ApiValues, ARenderFromFileToFileIsThatOfAPicture) {
  const RenderSettings s;
  EXPECT_EQ(s.metres_per_unit, 1);
  EXPECT_EQ(s.max_coc_px, 0);
  EXPECT_EQ(s.model, Lens().model);
  EXPECT_EQ(s.nonfinite, Options().nonfinite);
  EXPECT_FALSE(s.camera_from_metadata);
  EXPECT_TRUE(s.method.chain);
  EXPECT_EQ(s.method.method, Method::rdb);
}

TEST(ApiValues, AFrameIsOneLayerWithoutPixels) {
  const Frame f;
  for (const int none :
       {f.width, f.height, f.origin_x, f.origin_y, f.display_width, f.display_height, f.margin}) {
    EXPECT_EQ(none, 0);
  }
  EXPECT_EQ(f.layers, 1);
  EXPECT_EQ(f.pixels(), 0u);
}

}  // namespace
}  // namespace defray::test::api_values_test
