#pragma once
// The ray distribution buffer on OpenCL: scatter, merge, in memory-bounded passes.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "chain/highlights.h"
#include "lens/lens_cells.h"
#include "opencl/bands.h"
#include "opencl/session.h"
#include "rdb/fragments.h"
#include "rdb/rdb_plan.h"

namespace defray {

struct RdbSettings {
  int cells_per_side = 9;
  bool jitter = false;
  std::uint32_t seed = 0;
  std::size_t memory_bytes = default_memory_bytes;  ///< For cells and sums of one pass.
  LensCells samples = {};          ///< Points of the lens to use instead of a grid of cells.
  int origin_x = 0, origin_y = 0;  ///< Of the frame in the display window: jitter follows it.
  /// Cat's eye: the rim's centre for each column and row, 2^-16 of the aperture radius, as
  /// host/cats_eye.h has it. Empty: none.
  std::vector<std::int32_t> rim_x = {}, rim_y = {};
  bool wants_nearest = false;  ///< RdbResult::nearest is filled.
};

/// The lens points of these settings.
LensCells lens_cells(const RdbSettings& settings);

/// What the ray distribution buffers give.
struct RdbResult {
  std::vector<Plane> means;         ///< As many as there are channels.
  std::vector<std::uint32_t> seen;  ///< Cells of each pixel won by a fragment that was seen.
  /// The pixel whose data each pixel gets: of the nearest fragment with data among all its cells'
  /// winners (equal depths: the first in the frame). DEFRAY_EMPTY where there is none.
  std::vector<std::uint32_t> nearest = {};
};

/// Nearest hits with each pixel itself where there is none.
std::vector<std::uint32_t> or_own_pixel(std::vector<std::uint32_t> nearest);

/// Lens points that the rim leaves open for a pixel; all of them without one.
std::size_t open_cells(const RdbSettings& settings, const LensCells& cells, std::size_t x,
                       std::size_t y);

/// A frame on its way through the ray distribution buffers. The frame's planes must stay alive and
/// unchanged meanwhile. Passes go through scatter and merge in order.
class RdbRun {
 public:
  /// `lights`, if any, must stay alive too: all cells of a band are then in one pass.
  RdbRun(Session& session, const FragmentView& fragments, const RdbSettings& settings,
         const LightSources* lights = nullptr);

  const std::vector<RdbPass>& passes() const { return passes_; }

  /// Empties the cells of a pass and scatters into them.
  void scatter(const RdbPass& pass);

  /// Adds the cells of the last scatter to the band's sums; the band's last pass makes the means.
  void merge(const RdbPass& pass);

  /// Looks for the nearest hit among the cells of the last scatter.
  void nearest(const RdbPass& pass);

  /// Adds the light sources to the band's means.
  void add_light(const RdbPass& pass);

  /// Copies a finished band's part of the result.
  void read_band(const RdbPass& pass, RdbResult& out);

  /// Winners of the last scatter, [cell][band row][x].
  std::vector<RdbWinner> winners(const RdbPass& pass);

  bool is_last_of_band(const RdbPass& pass) const;
  void finish() { session_.finish(); }

 private:
  /// The source rows that can reach a band, on the device.
  struct Window {
    int band_y = -1;
    cl::Buffer coc, depth, coverage, data_of;
    std::optional<ChannelsOnDevice> channels;
  };
  struct Light {
    cl::Buffer first, list, where, excess, table, cell_map;
  };
  void view_window(const RdbPass& pass);
  DefrayRdbParams params_of(const RdbPass& pass) const;

  Session& session_;
  FragmentView fragments_;
  RdbSettings settings_;
  LensCells cells_;
  std::vector<RdbPass> passes_;
  Window window_;
  cl::Buffer lens_, rim_x_, rim_y_, winner_, sum_, filled_, seen_, nearest_;
  const LightSources* lights_;
  Light light_;
};

/// All passes. `progress` gets the share done, 0 to 1.
RdbResult distribute_rays(Session& session, const FragmentView& fragments,
                          const RdbSettings& settings, const LightSources* lights = nullptr,
                          const std::function<void(double)>& progress = {});

/// The lens picture of whole pixels: 1 to 4 channels in, as many out (Shinya's method itself).
std::vector<Plane> render_rdb(Session& session, int width, int height,
                              const std::vector<std::int32_t>& coc_quanta, const Plane& depth,
                              const std::vector<Plane>& channels, const RdbSettings& settings,
                              const std::function<void(double)>& progress = {});

}  // namespace defray
