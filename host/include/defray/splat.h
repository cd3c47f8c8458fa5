#pragma once
// Point clouds through the lens: EWA surface splatting with depth of field (Krivanek & Zara 2003).
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "defray/device.h"
#include "defray/export.h"
#include "defray/lens.h"
#include "defray/report.h"

namespace defray {

/// Points of surfaces. What is empty is estimated from the points around, or has a default.
struct PointCloud {
  std::array<double, 3> origin{};  ///< Scene units: places are from here, so that floats will do.
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;  ///< Of any length > 0. Empty: estimated.
  std::vector<float>
      radii;  ///< Of the disc that a point stands for, scene units. Empty: estimated.
  std::vector<std::array<float, 3>> colours;  ///< Linear. Empty: grey, with a light at the eye.
  std::vector<float> alpha;                   ///< 0 to 1. Empty: opaque.
  std::vector<std::string> notes;             ///< Of its reader: what is not used.
};

/// Where the camera stands. It looks along the picture's axis.
struct CameraPose {
  std::array<double, 3> from{0, 0, 1};
  std::array<double, 3> look_at{};
  std::array<double, 3> up{0, 1, 0};
};

/// How a point's light is spread over its circle of confusion.
enum class SplatPsf {
  gaussian,  ///< The paper's: the Gaussian that is nearest to the disc.
  disc,      ///< An even disc, of what each point of the lens sees of a surface.
};

/// What becomes of a surface's fragments where they weigh more than 1: where surfaces are too close
/// to be told apart.
enum class SplatMerge {
  nearest,  ///< The nearest count, up to 1.
  average,  ///< The paper's: all, divided by their sum.
};

struct SplatSettings {
  int width = 1024, height = 768;
  bool lod = true;      ///< Nodes of the hierarchy where blur hides single points.
  double cutoff = 2.5;  ///< c, 2 to 3: Gaussians end where they are down to e^-c.
  SplatPsf psf = SplatPsf::disc;
  SplatMerge merge = SplatMerge::nearest;
  int layers = 0;  ///< Surfaces that a pixel is made of at most, the nearest. 0: all.
  /// Surfaces are seen from both sides; otherwise from where normals point. Without normals those
  /// that are closed are seen from outside, by cameras that are, and others from both sides.
  bool two_sided = false;
  double transparency = 0;  ///< 0 to 1: all that points let through, beside their alpha.
};

struct SplatReport {
  std::size_t points = 0;  ///< Of the cloud.
  std::size_t drawn = 0;   ///< Nodes of the hierarchy that stood for them.
  std::size_t seen = 0;    ///< Of those, splats with pixels.
  /// Share of the cloud's surface that is shown from both sides.
  double both_sides = 0;
  /// Share of those drawn that have one side, and that the lens's centre sees from behind: left out
  /// where all of it does.
  double from_behind = 0;
  /// Those mostly lie before the others: given normals of closed surfaces point inwards.
  bool is_inside_out = false;
  double fragments = 0;     ///< Of all pixels, up to where nothing shines through.
  std::size_t spilled = 0;  ///< Pixels in which `layers` left something out that would be seen.
  double nearest_units = 0, farthest_units = 0;    ///< Depths of the splats seen.
  double nearest_coc_px = 0, farthest_coc_px = 0;  ///< Their signed CoC radii.
  std::vector<StageTime> stages;
  std::vector<std::string> tuned;  ///< As RenderReport::tuned.
};

/// Planes are row by row from the top, [height][width].
struct SplatResult {
  std::vector<std::vector<float>> colour;  ///< R G B A: linear, premultiplied.
  std::vector<float> depth;      ///< Of the nearest surface in a pixel, scene units; +inf: none.
  std::vector<float> fragments;  ///< How many a pixel had.
  SplatReport report;
};

/// A cloud made ready: normals, radii, weights and the hierarchy.
class DEFRAY_API SplatModel {
 public:
  /// Points without a finite place are left out; normals that are 0 or not finite, and radii that
  /// are not above 0, are estimated; each with a note. Throws Error(input) for a cloud without
  /// points, colours that are not finite, alpha outside 0 to 1, places and radii beyond 10^15
  /// units; Error(usage) for lists of different lengths.
  explicit SplatModel(const PointCloud& cloud, const Progress& progress = {});

  /// Of a file (read_point_cloud). With `has_cache` it is read from, or written to, a cache beside
  /// it, PATH.surfels, as long as the file stays as it is; a stale or damaged one is made anew, and
  /// noted. Throws Error(output) where it cannot be written.
  static SplatModel read(const std::string& path, bool has_cache, const Progress& progress = {});

  SplatModel(SplatModel&&) noexcept;
  SplatModel& operator=(SplatModel&&) noexcept;
  ~SplatModel();

  std::size_t points() const;  ///< Those with a place.
  /// What was left out or estimated.
  const std::vector<std::string>& notes() const;
  /// Centre and radius of a sphere around all points, scene units.
  std::array<double, 3> centre() const;
  double radius() const;
  /// Share of the surface whose outside is not known, because it has no normals and is not closed.
  double open_share() const;

 private:
  struct State;
  explicit SplatModel(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
  friend DEFRAY_API SplatResult splat(Device&, const SplatModel&, const CameraPose&, const Lens&,
                                      const SplatSettings&, const Progress&);
};

/// Renders the model through `lens`: the picture is as wide as its sensor. Throws Error(usage) for
/// settings out of range, Error(device).
DEFRAY_API SplatResult splat(Device& device, const SplatModel& model, const CameraPose& pose,
                             const Lens& lens, const SplatSettings& settings = {},
                             const Progress& progress = {});

/// A cloud from a file: PLY (ascii, binary of either byte order; vertex properties x y z, nx ny nz,
/// red green blue alpha, radius) or text with columns x y z [nx ny nz] [r g b] [.xyz .txt .csv
/// .pts]. 8-bit colours are sRGB, others linear. Throws Error(input).
DEFRAY_API PointCloud read_point_cloud(const std::string& path);

/// A built-in model: "plane", "figure", "crossing", "mask"; points beside each other as dense as
/// `points` says (0: the model's own number). Throws Error(usage).
DEFRAY_API PointCloud make_point_cloud(const std::string& name, std::size_t points = 0);

/// A camera far enough away that all of the model is in a picture of this shape.
DEFRAY_API CameraPose framing_pose(const SplatModel& model, const Lens& lens,
                                   const SplatSettings& settings);

}  // namespace defray
