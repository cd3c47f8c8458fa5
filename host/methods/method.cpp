#include "methods/method.h"

#include <array>

#include "base/error.h"
#include "chain/half_size.h"

namespace defray {
namespace {

/// What a method is called, and how it is run: all that there is to plug in.
struct Row {
  Method method;
  const char* name;
  bool has_lens;
  MethodResult (*run)(const Frame&, const MethodSettings&, Backend&, bool wants_nearest,
                      const Progress&);
};

MethodResult run_rdb(const Frame& f, const MethodSettings& s, Backend& backend, bool wants_nearest,
                     const Progress& progress) {
  if (s.chain) {
    const auto run = s.chain->half_size ? run_half_size : run_chain;
    return run(f, *s.chain, backend, wants_nearest, progress);
  }
  RayPlan plan = plan_rays(s.rdb);
  plan.wants_nearest = wants_nearest;
  RayResult result = backend.rays(f, plan, nullptr, progress);
  return {std::move(result.means), {}, or_own_pixel(std::move(result.nearest))};
}

MethodResult run_linear(const Frame& f, const MethodSettings&, Backend& backend, bool,
                        const Progress& progress) {
  return {taken(backend.linear(f, progress))};
}

MethodResult run_gather(const Frame& f, const MethodSettings& s, Backend& backend, bool,
                        const Progress& progress) {
  return {taken(backend.gather(f, s.gather, progress))};
}

/// Linear filtering divided by the light that each pixel got from a white frame: a lens blur as
/// photo editors have it. Where the radius changes, the plain sum would show as bright and dark
/// bands.
MethodResult run_tiltshift(const Frame& f, const MethodSettings&, Backend& backend, bool,
                           const Progress& progress) {
  MethodResult out{taken(backend.linear(f, progress))};
  Frame white_frame = f;
  white_frame.channels = Planes{Values<float>(f.pixels(), 1.0f)};
  const Plane white = std::move(taken(backend.linear(white_frame, progress)).front());
  for (Plane& plane : out.colour) {
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] /= white[i];
  }
  return out;
}

constexpr std::array method_rows{Row{Method::rdb, "rdb", true, run_rdb},
                                 Row{Method::linear, "linear", true, run_linear},
                                 Row{Method::gather, "gather", true, run_gather},
                                 Row{Method::tiltshift, "tiltshift", false, run_tiltshift}};

constexpr bool are_in_order() {
  for (std::size_t i = 0; i < method_rows.size(); ++i) {
    if (static_cast<std::size_t>(method_rows[i].method) != i) return false;
  }
  return true;
}
static_assert(are_in_order());

const Row& row_of(Method method) {
  require_named("method", method, method_rows.back().method);
  return method_rows[static_cast<std::size_t>(method)];
}

}  // namespace

void validate(const MethodSettings& s) {
  row_of(s.method);
  require_named("rdb.rays", s.rdb.rays, RaysBy::scatter);
  require_named("gather.kind", s.gather.kind, GatherKind::aware);
  if (!s.chain) return;
  require_named("rays", s.chain->rays, RaysBy::scatter);
  require_named("hidden", s.chain->hidden, Hidden::patterns);
  require_named("border", s.chain->border, Border::renormalise);
  constexpr int most_shifts = 64;
  if (s.chain->pattern_shifts < 1 || s.chain->pattern_shifts > most_shifts) {
    fail(ErrorKind::usage, "{} is {}: allowed are 1 to {}", field("pattern_shifts"),
         s.chain->pattern_shifts, most_shifts);
  }
}

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const Row& row : method_rows) methods.push_back(row.method);
  return methods;
}

const char* to_string(Method method) { return row_of(method).name; }

bool has_lens(Method method) { return row_of(method).has_lens; }

MethodResult apply_method(const Frame& frame, const MethodSettings& settings, Backend& backend,
                          bool wants_nearest, const Progress& progress) {
  return row_of(settings.method).run(frame, settings, backend, wants_nearest, progress);
}

}  // namespace defray
