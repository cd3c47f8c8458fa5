#include "defray/splat.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/vec3.h"
#include "lens/lens.h"
#include "library/backend_of.h"
#include "splat/cloud_cache.h"
#include "splat/clouds/models.h"
#include "splat/seen_sides.h"
#include "splat/splat_picture.h"
#include "splat/surfels/surfels.h"
#include "splat/view.h"
#include "tuning/results.h"

namespace defray {

namespace {

/// Of the sphere about its centre that holds all points.
double radius_of(const Hierarchy& tree) {
  const DefraySplatNode& root = tree.nodes.front().splat;
  double radius = 0;
  for (const DefraySplatNode& p : tree.points) {
    const double distance = length(Vec3{p.x, p.y, p.z} - Vec3{root.x, root.y, root.z});
    radius = std::max(radius, distance + 2 * std::sqrt(static_cast<double>(p.variance)));
  }
  return radius;
}

}  // namespace

struct SplatModel::State : CachedCloud {
  double radius = 0;
};

SplatModel::SplatModel(const PointCloud& cloud, const Progress& progress)
    : state_(std::make_unique<State>()) {
  Surfels surfels = make_surfels(cloud, progress);
  state_->origin = cloud.origin;
  state_->has_normals = surfels.has_normals;
  state_->has_colours = surfels.has_colours;
  state_->notes = std::move(surfels.notes);
  state_->tree = build_hierarchy(std::move(surfels.points), std::move(surfels.ridges));
  state_->radius = radius_of(state_->tree);
}

SplatModel::SplatModel(std::unique_ptr<State> state) : state_(std::move(state)) {
  state_->radius = radius_of(state_->tree);
}

namespace {

/// Names the file in what is wrong with its points.
SplatModel of_file(const std::string& path, const Progress& progress) {
  const PointCloud cloud = read_point_cloud(path);
  try {
    return SplatModel(cloud, progress);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    fail(ErrorKind::input, "{}: {}", path, error.what());
  }
}

}  // namespace

SplatModel SplatModel::read(const std::string& path, bool has_cache, const Progress& progress) {
  std::string why;
  if (has_cache) {
    if (std::optional<CachedCloud> cached = read_cache(path, why)) {
      return SplatModel(std::make_unique<State>(State{std::move(*cached), 0}));
    }
  }
  SplatModel model = of_file(path, progress);
  if (has_cache) write_cache(path, *model.state_);
  if (!why.empty()) model.state_->notes.push_back(why);
  return model;
}

SplatModel::SplatModel(SplatModel&&) noexcept = default;
SplatModel& SplatModel::operator=(SplatModel&&) noexcept = default;
SplatModel::~SplatModel() = default;

std::size_t SplatModel::points() const { return state_->tree.points.size(); }
const std::vector<std::string>& SplatModel::notes() const { return state_->notes; }

std::array<double, 3> SplatModel::centre() const {
  const DefraySplatNode& root = state_->tree.nodes.front().splat;
  const auto& origin = state_->origin;
  return {origin[0] + static_cast<double>(root.x), origin[1] + static_cast<double>(root.y),
          origin[2] + static_cast<double>(root.z)};
}

double SplatModel::radius() const { return state_->radius; }

double SplatModel::open_share() const {
  return static_cast<double>(state_->tree.nodes.front().splat.both_sides);
}

namespace {

/// Whether surfaces with one side are seen from there alone. What is found to be closed is a room
/// to those in it.
bool shows_outside(const CachedCloud& model, const DefraySplatParams& view) {
  return model.has_normals || !is_within(model.tree, {view.eye_x, view.eye_y, view.eye_z});
}

}  // namespace

SplatResult splat(Device& device, const SplatModel& model, const CameraPose& pose, const Lens& lens,
                  const SplatSettings& settings, const Progress& progress) {
  validate(settings);
  const SplatModel::State& m = *model.state_;
  DefraySplatParams params = splat_params(pose, m.origin, lens, settings);
  params.one_sided = !settings.two_sided && shows_outside(m, params);
  params.has_headlight = !m.has_colours;
  SplatResult out;
  const std::size_t pixels =
      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  const std::vector<std::string> tuned = use_tuning(device, tuning::cloud_class(pixels));
  SplatPlanes planes = draw_splats(backend_of(device), m.tree, params, settings.lod,
                                   settings.transparency, out.report, progress);
  out.report.is_inside_out &= m.has_normals;
  out.report.tuned = tuned;
  out.colour = std::move(planes.colour);
  out.depth = std::move(planes.depth);
  out.fragments = std::move(planes.fragments);
  return out;
}

PointCloud make_point_cloud(const std::string& name, std::size_t points) {
  return model_cloud(name, points);
}

CameraPose framing_pose(const SplatModel& model, const Lens& lens, const SplatSettings& settings) {
  validate(lens);
  validate(settings);
  CameraPose pose;
  pose.look_at = model.centre();
  pose.from = model.centre();
  pose.from[2] += framing_distance(model.radius(), lens, settings);
  return pose;
}

}  // namespace defray
