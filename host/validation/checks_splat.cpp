// The table's entries for point clouds.
#include "reference/twin_backend.h"
#include "splat/splats.h"
#include "validation/kernel_checks.h"
#include "validation/splat_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

/// Each field as a plane: its values differ in size from the others'.
Outcome run_project(Backend& backend, const Case& c, const Input&) {
  constexpr float DefraySplat::*fields[] = {
      &DefraySplat::x,        &DefraySplat::y,          &DefraySplat::conic_xx,
      &DefraySplat::conic_xy, &DefraySplat::conic_yy,   &DefraySplat::amplitude,
      &DefraySplat::disc_top, &DefraySplat::disc_bulge, &DefraySplat::lean_x,
      &DefraySplat::lean_y,   &DefraySplat::back,       &DefraySplat::z,
      &DefraySplat::z_near,   &DefraySplat::z_far,      &DefraySplat::r,
      &DefraySplat::g,        &DefraySplat::b,          &DefraySplat::a};
  static_assert(sizeof(DefraySplat) == (std::size(fields) + 5) * sizeof(float), "all of them");
  constexpr float DefraySplatLine::*of_lines[] = {&DefraySplatLine::at, &DefraySplatLine::x,
                                                  &DefraySplatLine::y, &DefraySplatLine::least};
  static_assert(sizeof(DefraySplatLine) == std::size(of_lines) * sizeof(float), "all of them");
  Outcome v;
  v.planes.resize(std::size(fields) + std::size(of_lines));
  const SplatInput input = splat_input(c);
  const Splats splats = backend.splat_project(input.nodes, input.ridges, splat_params(c));
  for (const DefraySplat& s : splats.all) {
    for (std::size_t i = 0; i < std::size(fields); ++i) v.planes[i].push_back(s.*fields[i]);
    const auto set = static_cast<std::int32_t>(s.lines);
    v.integers.insert(v.integers.end(), {s.first_x, s.end_x, s.first_y, s.end_y, set});
    const std::size_t end = (std::size_t{s.lines} + 1) * DEFRAY_SPLAT_RIDGES;
    if (s.lines == 0 || end > splats.lines.size()) continue;
    for (std::size_t k = 0; k < DEFRAY_SPLAT_RIDGES; ++k) {
      const DefraySplatLine& line = splats.lines[s.lines * DEFRAY_SPLAT_RIDGES + k];
      for (std::size_t i = 0; i < std::size(of_lines); ++i) {
        v.planes[std::size(fields) + i].push_back(line.*of_lines[i]);
      }
    }
  }
  return v;
}

Outcome run_resolve(Backend& backend, const Case& c, const Input&) {
  const DefraySplatParams params = splat_params(c);
  const SplatInput input = splat_input(c);
  Splats splats =
      in_order(reference::TwinBackend().splat_project(input.nodes, input.ridges, params));
  // A splat's pixels are those that it names, whatever its shape.
  for (DefraySplat& s : splats.all.edit()) {
    if (c.seed % 2 == 0) continue;
    s.end_x -= s.end_x - s.first_x > 2;
    s.first_y += s.end_y - s.first_y > 2;
  }
  SplatPlanes planes = backend.splat_resolve(splats, params);
  Outcome v{{}, std::move(planes.colour)};
  v.planes.push_back(std::move(planes.depth));
  v.planes.push_back(std::move(planes.fragments));
  return v;
}

/// A list's entry is a splat in a tile.
std::size_t resolve_memory(const Case& c, const Input&) {
  return static_cast<std::size_t>(c.band_rows) * 64;
}

}  // namespace

std::vector<KernelCheck> splat_checks() {
  return {{"splat_project", bits_rule, run_project, pixels},
          {"splat_resolve", bits_rule, run_resolve, splat_work, nullptr, nullptr, resolve_memory}};
}

}  // namespace defray::validation
