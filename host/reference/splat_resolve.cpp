// Twin of kernels/splat/splat_resolve.cl: every splat into all of its pixels, one after the other,
// without tiles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/falloff.h"
#include "reference/twin_backend.h"
#include "splat/splats.h"

namespace defray::reference {
namespace {

/// What a pixel has come to.
struct Pixel {
  float weight = 0;
  float layer[4] = {}, sum[4] = {};
  float layer_seen = 0, layer_z = 0;  ///< Its weights times alpha, and times depth.
  float far = -std::numeric_limits<float>::infinity();
  float depth = std::numeric_limits<float>::infinity();
  float count = 0;
  int ended = 0;
  bool is_opaque = false, has_spilled = false;

  void end_layer(bool averages) {
    float share = 1 - sum[3];
    if (averages) share /= std::fmax(weight, 1.0f);
    if (std::isinf(depth) && layer_seen > 0) depth = layer_z / layer_seen;
    for (int c = 0; c < 4; ++c) {
      sum[c] += share * layer[c];
      layer[c] = 0;
    }
    weight = layer_seen = layer_z = 0;
    is_opaque = 1 - sum[3] < DEFRAY_SPLAT_OPAQUE;
  }

  void add(const DefraySplat& s, float of_splat, const DefraySplatParams& p) {
    if (is_opaque || !(of_splat > 0)) return;
    if (s.z_near > far) {
      end_layer(p.averages);
      has_spilled = !is_opaque && ++ended > p.layers;
      is_opaque |= has_spilled;
    }
    if (is_opaque) return;
    const float taken = p.averages ? of_splat : std::fmin(of_splat, 1 - weight);
    weight += taken;
    const float colour[] = {s.r, s.g, s.b, s.a};
    for (int c = 0; c < 4; ++c) layer[c] += taken * colour[c];
    far = std::fmax(far, s.z_far);
    const float seen = of_splat * s.a;
    layer_seen += seen;
    layer_z += seen * s.z;
    ++count;
  }
};

float before_ridges(const DefraySplatLine* lines, float dx, float dy) {
  float left = 1;
  for (int i = 0; i < DEFRAY_SPLAT_RIDGES; ++i) {
    const float here = lines[i].at + lines[i].x * dx + lines[i].y * dy;
    left = std::fmin(left, std::fmax(here, lines[i].least));
  }
  return left;
}

float weight_at(const DefraySplat& s, const DefraySplatLine* lines, int x, int y,
                const DefraySplatParams& p) {
  const float dx = static_cast<float>(x) + 0.5f - s.x, dy = static_cast<float>(y) + 0.5f - s.y;
  const float form = (s.conic_xx * dx + 2 * s.conic_xy * dy) * dx + s.conic_yy * dy * dy;
  const float leant = s.amplitude + s.lean_x * dx + s.lean_y * dy;
  float facing = std::fmax(s.back * leant, leant);
  if (s.lines != 0) facing *= before_ridges(lines + s.lines * DEFRAY_SPLAT_RIDGES, dx, dy);
  if (s.disc_top > 0) {
    const float left = std::fmin(std::fmax(s.disc_top - form, 0.0f), 1.0f);
    return facing * (left * left * (1 + s.disc_bulge * (1 - left)));
  }
  const float inside = std::fmax(form, 0.0f);
  return form < p.cutoff ? facing * std::fmax(falloff(inside) - p.edge, 0.0f) : 0;
}

}  // namespace

SplatPlanes TwinBackend::splat_resolve(const Splats& given, const DefraySplatParams& p,
                                       const Progress& progress) {
  const Values<DefraySplat>& splats = given.all;
  const DefraySplatLine* lines = given.lines.begin();
  std::vector<Pixel> pixels(std::size_t{p.width} * p.height);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const DefraySplat& s = splats[i];
    for (int y = s.first_y; y < s.end_y; ++y) {
      for (int x = s.first_x; x < s.end_x; ++x) {
        pixels[size(y) * p.width + size(x)].add(s, weight_at(s, lines, x, y, p), p);
      }
    }
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(splats.size()));
  }
  SplatPlanes out;
  out.colour.resize(4);
  for (Pixel& pixel : pixels) {
    if (!pixel.is_opaque) pixel.end_layer(p.averages);
    for (std::size_t c = 0; c < 4; ++c) out.colour[c].push_back(pixel.sum[c]);
    out.depth.push_back(pixel.depth);
    out.fragments.push_back(pixel.has_spilled ? -pixel.count : pixel.count);
  }
  return out;
}

}  // namespace defray::reference
