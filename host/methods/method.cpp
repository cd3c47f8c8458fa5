#include "methods/method.h"

#include "base/error.h"
#include "reference/reference.h"

namespace defray {
namespace {

/// Linear filtering divided by the light that each pixel got from a white frame: a lens blur as
/// photo editors have it. Where the radius changes, the plain sum would show as bright and dark
/// bands.
template <typename Linear>
std::vector<Plane> apply_tiltshift(const std::vector<Plane>& channels, const Linear& linear) {
  std::vector<Plane> out = linear(channels);
  const Plane white = linear({Plane(channels[0].size(), 1.0f)})[0];
  for (Plane& plane : out) {
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] /= white[i];
  }
  return out;
}

std::vector<Plane> apply_rdb(const PinholeFrame& f, const RdbSettings& s, Session* session,
                             const std::function<void(double)>& progress, DefocusResult* details) {
  const FragmentView pixels(f.width, f.height, f.coc_quanta, f.depth, f.channels);
  RdbResult result = session ? distribute_rays(*session, pixels, s, nullptr, progress)
                             : reference::distribute_rays(pixels, s, nullptr, progress);
  if (details) details->nearest = or_own_pixel(std::move(result.nearest));
  return std::move(result.means);
}

std::vector<Plane> apply_twin(const PinholeFrame& f, const MethodSettings& s,
                              const std::function<void(double)>& progress, DefocusResult* details) {
  switch (s.method) {
    case Method::rdb:
      return apply_rdb(f, s.rdb, nullptr, progress, details);
    case Method::gather:
      return reference::render_gather(f.width, f.height, f.coc_quanta, f.channels, s.gather);
    case Method::linear:
      return reference::render_linear<float>(f.width, f.height, f.coc_quanta, f.channels);
    case Method::tiltshift:
      return apply_tiltshift(f.channels, [&](const std::vector<Plane>& planes) {
        return reference::render_linear<float>(f.width, f.height, f.coc_quanta, planes);
      });
  }
  fail(ErrorKind::internal, "a method without a twin");
}

}  // namespace

const char* to_string(Method method) {
  switch (method) {
    case Method::rdb:
      return "rdb";
    case Method::linear:
      return "linear";
    case Method::gather:
      return "gather";
    case Method::tiltshift:
      return "tiltshift";
  }
  return "";
}

std::vector<Plane> apply_method(const PinholeFrame& f, const MethodSettings& s, Session* session,
                                const std::function<void(double)>& progress,
                                DefocusResult* details) {
  if (s.method == Method::rdb && s.defocus) {
    DefocusResult result = defocus(f, *s.defocus, s.rdb, session, progress);
    std::vector<Plane> colour = std::move(result.colour);
    if (details) *details = std::move(result);
    return colour;
  }
  if (!session) return apply_twin(f, s, progress, details);
  switch (s.method) {
    case Method::rdb:
      return apply_rdb(f, s.rdb, session, progress, details);
    case Method::gather:
      return render_gather(*session, f.width, f.height, f.coc_quanta, f.channels, s.gather,
                           progress);
    case Method::linear:
      return render_linear(*session, f.width, f.height, f.coc_quanta, f.channels, s.linear,
                           progress);
    case Method::tiltshift:
      return apply_tiltshift(f.channels, [&](const std::vector<Plane>& planes) {
        return render_linear(*session, f.width, f.height, f.coc_quanta, planes, s.linear, progress);
      });
  }
  fail(ErrorKind::internal, "a method without a kernel");
}

}  // namespace defray
