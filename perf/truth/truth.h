#pragma once
// What the parts of the experiment `truth` share: scenes as productions have them, anti-aliased,
// beside what the lens really makes of them.
#include "bench.h"
#include "scenes/tracing/render.h"

namespace defray::perf {

/// Rays a pixel of the pinhole picture.
inline constexpr int pinhole_samples = 64;

/// A scene at one focus, and its truth.
struct Setup {
  std::string scene, setting;
  Subject subject;  ///< Colour is anti-aliased, depth is not.
  Truth truth;

  std::string name() const { return scene + (setting == "default" ? "" : " " + setting); }
  double psnr_db(const std::vector<Plane>& picture) const;
  /// The truth's own error: its mean is about 6 dB better than its halves are alike.
  double truth_db() const { return truth.noise->psnr_srgb_db + 6; }
};

/// Colour anti-aliased; depth too if asked, as far as it can be: the mean of what is hit.
Subject make_antialiased(Backend& backend, Scene scene, const std::string& setting,
                         bool averages_depth = false);

/// At this size, a quarter of it when quick.
Setup make_setup(const Bench& bench, const std::string& scene, const std::string& setting,
                 int width, int height);

std::vector<Setup> make_setups(const Bench& bench);

/// `defray render` with --quality alone.
MethodSettings default_chain(Quality quality = Quality::normal);

/// PSNR and time with and without each mechanism.
void add_mechanisms(const Bench& bench, const std::vector<Setup>& setups, Section& section);

/// PSNR with exact hidden surfaces, exact coverage, more lens points: what is left, and why.
void add_split(const Bench& bench, const std::vector<Setup>& setups, Section& section);

/// Pictures side by side.
void add_pictures(const Bench& bench, const std::vector<Setup>& setups, Section& section);

/// Frame-to-frame error of a moving scene.
void add_motion(const Bench& bench, Section& section);

}  // namespace defray::perf
