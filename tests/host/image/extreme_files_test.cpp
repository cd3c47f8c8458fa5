// Files at the limits of their numbers: what comes in as depth never reaches a kernel as no depth,
// and half floats come out as they went in.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "defray/io.h"
#include "image/image_file.h"
#include "lens/depth.h"
#include "numbers.h"
#include "support.h"

namespace defray::test::extreme_files_test {
namespace {

const std::vector<float> extreme_depths{
    0.0f,     -0.0f, denormal, -denormal, 1e-38f,  1e-6f,    -1e-6f, 0.5f, 1.0f,     3.0f,     -3,
    65504.0f, 1e9f,  1e10f,    1e12f,     largest, -largest, nan,    -nan, infinite, -infinite};

std::vector<DepthSettings> all_kinds() {
  std::vector<DepthSettings> all;
  for (const DepthKind kind : {DepthKind::z, DepthKind::distance, DepthKind::inverse,
                               DepthKind::normalized, DepthKind::negative_z, DepthKind::zbuffer}) {
    for (const std::optional<double> background :
         {std::optional<double>(), {0.5}, {double{infinite}}, {double{nan}}}) {
      DepthSettings s;
      s.kind = kind;
      s.background = background;
      if (kind == DepthKind::normalized || kind == DepthKind::zbuffer) {
        s.near_units = 1, s.far_units = 1e30;
      }
      all.push_back(s);
    }
  }
  return all;
}

TEST(ExtremeFiles, NoDepthIsPassedOnThatIsNotAboveZero) {
  std::size_t converted = 0, refused = 0;
  for (const DepthSettings& settings : all_kinds()) {
    for (const float stored : extreme_depths) {
      Plane depth{stored};
      try {
        const Window pixel{0, 0, 1, 1};
        const auto report = convert_depth(depth, settings, pixel, {0, 0, 9, 9}, 5, "z.exr");
        ++converted;
        EXPECT_GT(depth[0], 0) << stored;
        EXPECT_EQ(report.background, std::isinf(depth[0]) ? 1u : 0u) << stored;
        EXPECT_EQ(report.not_a_number, std::isnan(stored) ? 1u : 0u) << stored;
        EXPECT_LE(report.farthest_units, double{largest}) << stored;
      } catch (const Error& error) {
        ++refused;
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_TRUE(std::isfinite(stored)) << "NaN and inf are background: " << error.what();
      }
    }
  }
  EXPECT_GT(converted, refused);
  EXPECT_GT(refused, 0u);
}

TEST(ExtremeFiles, NormalizedDepthNeedsAFiniteFarEnd) {
  DepthSettings s;
  s.kind = DepthKind::normalized;
  s.near_units = 1, s.far_units = double{infinite};
  expect_error(ErrorKind::usage, {"near_units < far_units", "inf"}, [&] { validate(s); });
}

RenderSettings settings_of(Method method, GatherKind kind, double aperture_mm) {
  RenderSettings s;
  s.camera.focal_length_mm = 50;
  s.camera.focus_distance_units = 3;
  s.camera.aperture_diameter_mm = aperture_mm;
  s.nonfinite = Nonfinite::keep;
  s.method.method = method;
  s.method.gather.kind = kind;
  return s;
}

const std::pair<Method, GatherKind> all_methods[] = {{Method::rdb, {}},
                                                     {Method::linear, {}},
                                                     {Method::gather, GatherKind::literal},
                                                     {Method::gather, GatherKind::aware}};

/// A row of pictures' limits: half floats' largest, smallest normal, smallest; and what is no
/// number.
const Plane half_limits{65504, -65504, 0x1p-14f, -0x1p-14f, 0x1p-24f,  -0x1p-24f,
                        0.0f,  -0.0f,  1.0f,     infinite,  -infinite, 0x1.ffcp0f};

TEST(ExtremeFiles, HalfFloatsAtTheirLimitsPassAClosedApertureBitForBit) {
  const Folder folder;
  const int count = static_cast<int>(half_limits.size());
  Plane reversed(half_limits.rbegin(), half_limits.rend());
  Plane depth{65504, 0x1p-24f, 0x1p-14f, infinite, 1, 2, 3, 4, 5, 6, 7, 0};
  ImageFile::from_planes({"R", "G", "B", "Z"}, {half_limits, reversed, half_limits, depth}, count,
                         1)
      .write(folder / "in.exr");
  Device devices[] = {Device::open(), Device::reference()};
  for (const auto& [method, kind] : all_methods) {
    for (Device& device : devices) {
      const auto result = render_file(device, {folder / "in.exr", "", folder / "out.exr", ""},
                                      settings_of(method, kind, 0));
      EXPECT_EQ(result.report.depth.background, 3u);  // 65504, inf and 0
      const ImageFile out = ImageFile::read(folder / "out.exr");
      std::vector<Plane> planes;
      for (int c = 0; c < 4; ++c) planes.push_back(out.plane(0, c));
      EXPECT_EQ(hash_of(planes), hash_of({half_limits, reversed, half_limits, depth}))
          << "method " << static_cast<int>(method);
    }
  }
}

TEST(ExtremeFiles, LightBeyondHalfFloatsIsWrittenAsInfAndReported) {
  // linear piles discs up where the radius changes: two depths side by side do.
  const Folder folder;
  Plane depth(20 * 20, 1.0f);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (i % 20 < 10) depth[i] = 3;
  }
  const Plane bright(depth.size(), 65504.0f);
  Device device = Device::open();
  for (const Sample sample : {Sample::half_float, Sample::single_float}) {
    ImageFile::from_planes({"R", "G", "B", "Z"}, {bright, bright, bright, depth}, 20, 20, sample)
        .write(folder / "in.exr");
    const auto result = render_file(device, {folder / "in.exr", "", folder / "out.exr", ""},
                                    settings_of(Method::linear, {}, 200));
    const Plane stored = ImageFile::read(folder / "out.exr").plane(0, 0);
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < stored.size(); ++i) {
      const float exact = result.colour[0][i];
      const bool is_lost = sample == Sample::half_float && exact >= 65520;  // rounds to 65536
      EXPECT_EQ(std::isinf(stored[i]), is_lost) << exact;
      beyond += exact >= 65520;
    }
    EXPECT_GT(beyond, 0u);
    const std::string note = std::to_string(3 * beyond) + " values beyond half float's 65504";
    const auto& notes = result.report.notes;
    EXPECT_EQ(std::any_of(notes.begin(), notes.end(),
                          [&](const std::string& n) { return n.starts_with(note); }),
              sample == Sample::half_float);
  }
}

TEST(ExtremeFiles, NanDepthIsBackgroundThroughTheWholePipeline) {
  const Folder folder;
  const Size size{23, 17};
  Plane depth = random_depth(size, 3), with_nan = depth;
  std::size_t changed = 0;
  for (float& z : with_nan) {
    constexpr float nothing[] = {nan, -nan, -infinite, 0.0f, -0.0f, -5.0f, 65504.0f, 1e10f};
    if (std::isinf(z)) z = nothing[changed++ % 8];
  }
  ASSERT_GT(changed, 8u);
  const Plane r = random_plane(size, 4), g = random_plane(size, 5), b = random_plane(size, 6);
  const auto write = [&](const char* name, const Plane& z) {
    ImageFile::from_planes({"R", "G", "B", "Z"}, {r, g, b, z}, 23, 17, Sample::single_float)
        .write(folder / name);
  };
  write("inf.exr", depth);
  write("nan.exr", with_nan);
  Device devices[] = {Device::open(), Device::reference()};
  for (const auto& [method, kind] : all_methods) {
    const RenderSettings settings = settings_of(method, kind, 100);
    for (Device& device : devices) {
      const auto colour_of = [&](const char* name) {
        return render_file(device, {folder / name, "", folder / "out.exr", ""}, settings).colour;
      };
      EXPECT_EQ(hash_of(colour_of("nan.exr")), hash_of(colour_of("inf.exr")))
          << "method " << static_cast<int>(method);
    }
  }
}

}  // namespace
}  // namespace defray::test::extreme_files_test
