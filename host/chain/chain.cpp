#include "chain/chain.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "chain/plan/ray_plan.h"
#include "chain/steps/behind.h"
#include "chain/steps/border.h"
#include "chain/steps/front.h"
#include "chain/steps/layered.h"

namespace defray {
namespace {

/// What comes of the rays, row by row of the picture.
class Picture {
 public:
  Picture(const Frame& extended, ChainWork& work) : f_(extended), work_(work) {}

  /// Rows of the extended frame, with the margin beside them.
  void add(Rows rows, RayResult result) {
    if (rows.count() == f_.height) {
      out_.colour = std::move(result.means);
      parallel_for(static_cast<int>(out_.colour.size()),
                   [&](int c) { crop(out_.colour[size(c)]); });
    } else {
      out_.colour.resize(result.means.size());
      parallel_for(static_cast<int>(result.means.size()),
                   [&](int c) { append(rows, result.means[size(c)], out_.colour[size(c)]); });
    }
    add_confidence(rows, result.seen);
    if (work_.plan.wants_nearest) append(rows, result.nearest, out_.nearest);
  }

  /// The picture that `frame` gives.
  MethodResult finish(const Frame& frame) {
    if (frame.has_alpha) limit_alpha(frame.channels.back(), out_.colour);
    if (work_.plan.wants_nearest) out_.nearest = or_own_pixel(std::move(out_.nearest));
    work_.report.confidence = confidence_ / static_cast<double>(out_.confidence.size());
    work_.report.tiles = work_.tiles.shares();
    out_.tiles = std::move(work_.tiles);
    work_.done("crop");
    out_.report = std::move(work_.report);
    return std::move(out_);
  }

  /// Where sources shine on other rows, light of none was added to these: -0 is then 0 as well.
  void add_no_light(Rows rows) {
    const Rows own = of_picture(rows);
    const std::size_t width = size(f_.width - 2 * f_.margin);
    for (Plane& plane : out_.colour) {
      for (std::size_t i = size(own.y - f_.margin) * width; i < size(own.end - f_.margin) * width;
           ++i) {
        plane[i] += 0.0f;
      }
    }
  }

  Rows of_picture(Rows rows) const {
    return {std::max(rows.y, f_.margin), std::min(rows.end, f_.height - f_.margin)};
  }

 private:
  /// In place: new memory costs more.
  void crop(Plane& plane) const {
    if (f_.margin == 0) return;
    const std::size_t width = size(f_.width - 2 * f_.margin);
    auto to = plane.begin();
    for (int y = f_.margin; y < f_.height - f_.margin; ++y) {
      const auto row = plane.begin() + std::int64_t{y} * f_.width + f_.margin;
      to = std::copy(row, row + static_cast<std::ptrdiff_t>(width), to);
    }
    plane.erase(to, plane.end());
  }

  template <typename T>
  void append(Rows rows, const std::vector<T>& plane, std::vector<T>& out) const {
    const Rows own = of_picture(rows);
    const std::size_t width = size(f_.width - 2 * f_.margin);
    if (out.empty()) out.reserve(width * size(f_.height - 2 * f_.margin));
    for (int y = own.y; y < own.end; ++y) {
      const auto row =
          plane.begin() + std::int64_t{y - rows.y} * f_.width + std::int64_t{f_.margin};
      out.insert(out.end(), row, row + static_cast<std::ptrdiff_t>(width));
    }
  }

  void add_confidence(Rows rows, const std::vector<std::uint32_t>& seen) {
    const std::size_t width = size(f_.width - 2 * f_.margin), margin = size(f_.margin);
    const Rows own = of_picture(rows);
    if (out_.confidence.empty()) out_.confidence.resize(width * size(f_.height - 2 * f_.margin));
    float* const confidence = &out_.confidence[width * (size(own.y) - margin)];
    std::vector<double> sums(size(own.count()));
    parallel_for(own.count(), [&](int row) {
      const int y = own.y + row;
      const std::uint32_t* const seen_in_row = &seen[size(y - rows.y) * size(f_.width) + margin];
      for (std::size_t x = 0; x < width; ++x) {
        const std::size_t open = open_cells(work_.plan, x + margin, size(y));
        const std::size_t known = std::min<std::size_t>(seen_in_row[x], open);  // between rows
        float& share = confidence[size(row) * width + x];
        share = open == 0 ? 0.0f : static_cast<float>(known) / static_cast<float>(open);
        sums[size(row)] += double{share};
      }
    });
    confidence_ = std::accumulate(sums.begin(), sums.end(), confidence_);
  }

  /// Discs and rays of one surface meet along other borders than pixels do: a little more than all
  /// of it can come together. Light and alpha give way alike, so that colour stays premultiplied.
  static void limit_alpha(const Values<float>& pinhole, std::vector<Plane>& colour) {
    float most = 0;
    for (const float a : pinhole) most = a > most ? a : most;
    parallel_for_each(pinhole.size(), [&](std::size_t i) {
      const float alpha = colour.back()[i];
      if (!(alpha > most * 1.000001f)) return;
      for (Plane& plane : colour) plane[i] *= most / alpha;
    });
  }

  const Frame& f_;
  ChainWork& work_;
  MethodResult out_;
  double confidence_ = 0;
};

/// All bands, one after the other; stages before the rays run as far ahead as they have to.
MethodResult send_rays(const Frame& frame, const Front& front, Layered& layers, ChainWork& work,
                       const Progress& progress) {
  const int height = front.frame.height;
  Picture picture(front.frame, work);
  std::vector<Rows> dark;
  for (int y = 0; y < height; y += work.bands.rows) {
    const Rows rows{y, std::min(height, y + work.bands.rows)};
    if (picture.of_picture(rows).empty()) continue;
    layers.to(rows.end + work.reach.rays);
    if (work.bands.gives_back) layers.give_back_to(rows.y);
    {
      const Frame f = layers.frame_for_rays(rows);
      const LightSources lights = layers.lights_for_rays(f);
      if (lights.empty()) dark.push_back(rows);
      const auto of_all = [&](double share) {
        progress((y + share * rows.count()) / static_cast<double>(height));
      };
      RayResult result =
          work.backend.rays(f, work.plan, &lights, progress ? Progress(of_all) : Progress());
      work.done("rays");
      work.report.interpolated += result.interpolated;
      picture.add(rows, std::move(result));
      work.done("crop");
    }
    if (work.is_banded) layers.give_back_to(rows.end);
  }
  work.tiles.add(layers.lights());
  work.report.highlights = layers.lights().where.size();
  for (const Rows& rows : dark) {
    if (!layers.lights().empty()) picture.add_no_light(rows);
  }
  return picture.finish(frame);
}

/// How the chain goes through the frame.
void plan_bands(const Frame& frame, const Frame& extended, ChainWork& work) {
  const PlaneCounts planes{frame.channels.size(), frame.has_alpha, work.plan.wants_nearest};
  work.bands = chain_bands(extended, planes, work.reach, work.backend.memory_for_planes());
  work.is_banded = work.bands.rows < extended.height;
  work.backend.require_memory(frame, bytes_of_bands(extended, planes, work.reach, work.bands) +
                                         frame.pixels() * (planes.channels + 2) * sizeof(float));
}

}  // namespace

MethodResult run_chain(const Frame& frame, const ChainSettings& settings, Backend& backend,
                       bool wants_nearest, const Progress& progress) {
  ChainWork work(settings, backend);
  work.plan = ray_plan(settings, wants_nearest);
  work.report.lens_points = static_cast<int>(work.plan.lens.points.size());
  work.reach = chain_reach(frame, settings, work.report.lens_points);
  work.done("lens");
  Front front(frame, work);
  plan_bands(frame, front.frame, work);
  work.tiles = TileClasses(front.frame);
  front.look_at_all();
  Behind behind(front, work);
  if (front.has_edges()) behind.look_at_all();
  place_rays(front.frame, settings.aperture.cats_eye, work.plan);
  work.done("lens");
  Layered layers(front, behind, work);
  return send_rays(frame, front, layers, work, progress);
}

}  // namespace defray
