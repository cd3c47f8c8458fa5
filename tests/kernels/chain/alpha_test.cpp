// Alpha through the lens: opaque stays opaque, nothing stays nothing, coverage is kept.
#include <cmath>
#include <limits>

#include "chain/chain.h"
#include "lens/camera.h"
#include "lens/lens.h"
#include "methods/method.h"
#include "reference/reference.h"
#include "scenes/tracing/render.h"
#include "support.h"

namespace defray::test::alpha_test {
namespace {

/// Blocks of colour at random depths, half covered edges, and lights of 1000 times white.
struct Layer {
  Size size;
  std::vector<std::int32_t> coc;
  Plane depth;
  std::vector<Plane> channels;  ///< R G B A, premultiplied.
  Frame frame() const { return {size.width, size.height, coc, depth, channels, true}; }
};

Layer blocks(Size size, std::uint32_t seed) {
  const Plane depth = random_depth(size, seed);
  Layer l{size, {}, {}, {}};
  for (std::uint32_t c = 0; c < 3; ++c) l.channels.push_back(random_plane(size, seed + c + 1));
  l.channels.emplace_back(depth.size(), 1.0f);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float z = depth[static_cast<std::size_t>(y / 9 * size.width + x / 11 * 11)];
      l.depth.push_back(z);
      const float coc_px = 12 * (std::isinf(z) ? 1 : (z - 3) / z);
      l.coc.push_back(static_cast<std::int32_t>(std::lround(256 * coc_px)));
    }
  }
  for (std::size_t i = seed % 7; i < depth.size(); i += 97) {
    for (std::size_t c = 0; c < 3; ++c) l.channels[c][i] = 1000;
  }
  return l;
}

std::vector<ChainSettings> all_settings() {
  std::vector<ChainSettings> all(1);
  for (const int cells : {9, 33}) all.emplace_back().cells_per_side = is_slow_device() ? 3 : cells;
  for (const Hidden h : {Hidden::off, Hidden::fill}) all.emplace_back().hidden = h;
  for (const Border b : {Border::renormalise, Border::black}) all.emplace_back().border = b;
  all.emplace_back().split = false;
  all.emplace_back().repair = false;
  all.emplace_back().highlights = false;
  all.emplace_back().soften = false;
  all.emplace_back().aperture.cats_eye = 0.7;
  return all;
}

TEST(Alpha, AnOpaqueImageStaysOpaque) {
  for (std::uint32_t seed = 1; seed <= 2; ++seed) {
    const Layer l = blocks({83, 61}, seed);
    std::size_t split = 0, behind = 0, lights = 0;
    for (const ChainSettings& settings : all_settings()) {
      if (settings.border == Border::black) continue;  // beyond the frame there is nothing
      const MethodResult r = run_chain(l.frame(), settings, device());
      split += r.report->split, behind += r.report->behind, lights += r.report->highlights;
      double worst = 0;
      for (const float a : r.colour[3]) worst = std::max(worst, std::fabs(a - 1.0));
      EXPECT_LE(worst, 1e-6);
    }
    EXPECT_GT(split, 0u);
    EXPECT_GT(behind, 0u);
    EXPECT_GT(lights, 0u);
  }
}

TEST(Alpha, OpaqueWithoutStagesTooAndInTheTwins) {
  const Layer l = blocks({47, 33}, 3);
  for (Backend* on : device_and_twins()) {
    const auto literal = apply_method(l.frame(), {}, *on).colour;
    const MethodResult whole = run_chain(l.frame(), {}, *on);
    for (const float a : literal[3]) EXPECT_NEAR(a, 1.0f, 1e-6f);
    for (const float a : whole.colour[3]) EXPECT_NEAR(a, 1.0f, 1e-6f);
  }
}

/// Nothing but a block in the middle: alpha 0 and colour 0 around it, as far as can be.
Layer block_before_nothing(float block_coc_px) {
  Layer l{{64, 48}, {}, {}, {}};
  l.channels.resize(4);
  for (int i = 0; i < 64 * 48; ++i) {
    const int x = i % 64, y = i / 64;
    const bool is_block = x >= 24 && x < 40 && y >= 16 && y < 32;
    l.coc.push_back(is_block ? static_cast<std::int32_t>(256 * block_coc_px) : 9 * 256);
    l.depth.push_back(is_block ? 2.0f : std::numeric_limits<float>::infinity());
    for (std::size_t c = 0; c < 3; ++c) l.channels[c].push_back(is_block ? 0.25f * (c + 1.0f) : 0);
    l.channels[3].push_back(is_block ? 1 : 0);
  }
  return l;
}

TEST(Alpha, NothingStaysNothingAndColourStaysPremultiplied) {
  for (const float coc_px : {0.0f, -5.0f, 4.0f}) {
    const Layer l = block_before_nothing(coc_px);
    for (const ChainSettings& settings : all_settings()) {
      const auto out = run_chain(l.frame(), settings, device()).colour;
      for (int i = 0; i < 64 * 48; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const float alpha = out[3][at];
        EXPECT_GE(alpha, 0.0f);
        EXPECT_LE(alpha, 1.0f + 1e-6f);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(out[c][at], 0.25f * (c + 1.0f) * alpha, 2e-6f);
        }
        const int x = i % 64, y = i / 64;
        const bool is_far = x < 24 - 7 || x >= 40 + 7 || y < 16 - 7 || y >= 32 + 7;
        if (is_far) {
          EXPECT_EQ(alpha, 0.0f) << x << ", " << y;
        }
      }
    }
  }
}

/// What the built-in cut-out's alpha is off by: mean and RMS over the frame.
struct Off {
  double mean, rms, worst, noise;
};

Off cutout_off(const std::string& setting, int cells_per_side) {
  const Scene scene = make_scene("cutout", 160, 120);
  const Lens lens = lens_of(scene, find_setting(scene, setting));
  const ScenePicture pinhole = render_pinhole(scene, {64});
  const Truth truth = render_truth(scene, lens, 64, 1);
  Plane depth = pinhole.depth;
  for (float& z : depth) {
    if (z >= 1e9f) z = std::numeric_limits<float>::infinity();
  }
  std::vector<Plane> channels = pinhole.colour;
  channels.push_back(pinhole.alpha);
  const auto coc = twins().coc(lens, 160, depth);
  ChainSettings settings;
  settings.cells_per_side = cells_per_side;
  const MethodResult r = run_chain({160, 120, coc, depth, channels, true}, settings, device());
  Off off{0, 0, 0, truth.alpha_noise_rms};
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double d = static_cast<double>(r.colour[3][i]) - truth.alpha[i];
    off.mean += d, off.rms += d * d, off.worst = std::max(off.worst, std::fabs(d));
  }
  const auto count = static_cast<double>(depth.size());
  return {off.mean / count, std::sqrt(off.rms / count), off.worst, off.noise};
}

// Total coverage. Pixel by pixel, what hides where silhouettes cross has to be guessed.
TEST(Alpha, ADefocusedCutOutCoversAsMuchAsTheTruth) {
  for (const std::string setting : {"near", "far"}) {
    const Off off = cutout_off(setting, 13);
    RecordProperty(setting, fmt::format("mean {:.5f} rms {:.5f} worst {:.3f} truth's noise {:.5f}",
                                        off.mean, off.rms, off.worst, off.noise));
    EXPECT_LE(std::fabs(off.mean), 1e-3) << setting;
  }
}

}  // namespace
}  // namespace defray::test::alpha_test
