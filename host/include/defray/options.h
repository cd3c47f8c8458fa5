#pragma once
// The methods and their settings.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "defray/export.h"
#include "defray/lens.h"

namespace defray {

enum class Method {
  rdb,        ///< Ray distribution buffer (Shinya 1994).
  linear,     ///< Each pixel spread over its PSF (Potmesil & Chakravarty 1981).
  gather,     ///< Poisson-disk gather (Glatzel & Wilhelm).
  tiltshift,  ///< A mean with `linear`'s weights, its CoC from the pixel's row: no depth.
};

/// In the order of their rows (host/methods/method.cpp).
DEFRAY_API std::vector<Method> all_methods();

/// "rdb", as on the command line.
DEFRAY_API const char* to_string(Method method);

/// Whether its circles of confusion are a lens's, by depth.
DEFRAY_API bool has_lens(Method method);

/// How rays are followed: the same picture, bit for bit.
enum class RaysBy {
  gather,   ///< From where they end; jitter goes by scatter.
  scatter,  ///< From where they begin, as the paper does.
};

/// The ray distribution buffer as the paper has it.
struct RdbSettings {
  int cells_per_side = 9;  ///< Of the lens, 1 to 64.
  bool jitter = false;     ///< Shifts each pixel's lens points: noise instead of patterns.
  std::uint32_t seed = 0;
  RaysBy rays = RaysBy::gather;
};

/// What is taken to be outside the frame. The data window is the frame: overscan is used as it is.
enum class Border {
  clamp,        ///< The frame's edge goes on, as far as it can reach in, at most half the frame.
  black,        ///< The same surfaces, without light.
  renormalise,  ///< Nothing: pixels are means over the rays that are known.
};

/// What is done about what lies behind.
enum class Hidden {
  off,
  fill,      ///< Made up from what is around.
  patterns,  ///< And from where the picture repeats itself.
};

/// The stages that bring the ray distribution buffer closer to the truth.
struct ChainSettings {
  int cells_per_side = 13;  ///< As many lens points as round cells of such a grid.
  Hidden hidden = Hidden::patterns;
  /// Shifts at which Hidden::patterns looks, each with both its signs; 1 to 64.
  int pattern_shifts = 24;
  bool split = true;
  bool repair = true;
  bool highlights = true;
  bool soften = true;
  bool sparse = true;  ///< Interpolates between rows of pixels where all circles are large.
  RaysBy rays = RdbSettings().rays;
  Border border = Border::clamp;
  Aperture aperture;
  /// Works on a quarter of the pixels, means of four, and puts the detail of sharp ones back.
  bool half_size = false;
};

enum class Quality { preview, draft, normal, high };

/// The fastest first.
inline constexpr std::array all_qualities{Quality::preview, Quality::draft, Quality::normal,
                                          Quality::high};

/// "draft", as on the command line.
DEFRAY_API const char* to_string(Quality quality);

/// What goes together, the fastest first; Quality::normal is ChainSettings().
DEFRAY_API ChainSettings settings_for(Quality quality);

enum class GatherKind {
  literal,  ///< The paper: each pixel averages within its own CoC, and bleeds.
  aware,    ///< Each sample is weighed by whether its light arrives.
};

struct GatherSettings {
  GatherKind kind = GatherKind::aware;
  int samples = 32;     ///< A pass, a pixel; 1 to 1024.
  int passes = 2;       ///< The paper's count; later passes work on the result of the one before.
  bool rotate = false;  ///< Turns each pixel's samples by an angle of its own.
  std::uint32_t seed = 0;
};

/// Lengths in heights of the display window, from its top.
struct TiltshiftSettings {
  double band_centre = 0.5;  ///< 0 to 1.
  double band_width = 0.2;   ///< Height of the sharp band, 0 to 1.
  double max_blur_px = 9.2;  ///< Radius at the frame's edge that is farthest from the band.
};

struct MethodSettings {
  Method method = Method::rdb;
  RdbSettings rdb;
  /// rdb: with the stages that bring it closer to the truth. Empty: Shinya's method alone.
  std::optional<ChainSettings> chain;
  GatherSettings gather;
};

enum class DepthKind {
  z,           ///< Planar, along the camera's axis.
  distance,    ///< Along the ray from the camera.
  inverse,     ///< 1 / planar depth.
  normalized,  ///< 0 at `near`, 1 at `far`, linear in planar depth.
  negative_z,  ///< Minus the planar depth: z of a camera that looks along its -z axis.
  zbuffer,     ///< 0 at `near`, 1 at `far`, linear in 1 / planar depth: a GPU's depth buffer.
};

/// How many bits an output has a channel.
enum class Bits {
  as_input,  ///< As the input; 8 in PNG and JPEG where that has floats.
  eight,
  sixteen,
  half,
  single,
};

/// How far a data window grows with the blur of what lies in it.
enum class Grow {
  none,
  display,  ///< As far as light gets, at most to the display window.
  full,     ///< Beyond that, too.
};

/// What the values of a depth plane mean.
struct DepthSettings {
  DepthKind kind = DepthKind::z;
  bool invert = false;    ///< normalized, zbuffer: 1 at near, 0 at far.
  double near_units = 0;  ///< Of these two.
  double far_units = 0;
  /// The stored value that means "nothing there". Empty: 65504, anything >= 1e9, inf and <= 0.
  std::optional<double> background;
};

/// What to do with NaN and Inf colours.
enum class Nonfinite {
  error,
  zero,
  keep,  ///< They spread over the CoC of their pixel.
};

/// What is to be known of a picture's error, or asked of it, without a truth: of the RDB with its
/// stages.
struct ErrorSettings {
  bool wants_expected = false;  ///< RenderReport::expected.
  bool wants_planes = false;    ///< RenderResult::expected_error; with wants_expected or a target.
  /// Expected PSNR, dB: the fastest quality and number of lens points that are expected to reach it
  /// make the picture, the highest where none are; the qualities' own settings do not count then.
  std::optional<double> target_db = {};
  /// With target_db, of a sequence: ExpectedError::next_quality and next_cells_per_side of the
  /// frame before. The search begins there, so that the quality changes rarely; else with the
  /// fastest.
  std::optional<Quality> first_quality = {};
  int first_cells_per_side = 0;
};

/// All that render() is told beside the lens. As they are: the ray distribution buffer with all its
/// stages, as `defray render` without options.
struct Options : MethodSettings {
  Options() { chain.emplace(); }
  TiltshiftSettings tiltshift;
  DepthSettings depth;
  Nonfinite nonfinite = Nonfinite::zero;
  bool wants_nearest = false;  ///< rdb: RenderResult::nearest.
  /// rdb with its stages: the best quality that is expected to take so long at the most; the
  /// qualities' own settings do not count then. The device learns from picture to picture.
  std::optional<double> budget_ms;
  ErrorSettings error;
};

}  // namespace defray
