#include "method.h"

#include "reference/reference.h"

namespace defray {
namespace {

std::vector<Plane> apply_twin(const PinholeFrame& f, const MethodSettings& s,
                              const std::function<void(double)>& progress) {
  switch (s.method) {
    case Method::rdb:
      return reference::render_rdb(f.width, f.height, f.coc_quanta, f.depth, f.channels, s.rdb,
                                   progress);
    case Method::gather:
      return reference::render_gather(f.width, f.height, f.coc_quanta, f.channels, s.gather);
    default:
      return reference::render_linear<float>(f.width, f.height, f.coc_quanta, f.channels);
  }
}

}  // namespace

std::vector<Plane> apply_method(const PinholeFrame& f, const MethodSettings& s, Session* session,
                                const std::function<void(double)>& progress) {
  if (!session) return apply_twin(f, s, progress);
  switch (s.method) {
    case Method::rdb:
      return render_rdb(*session, f.width, f.height, f.coc_quanta, f.depth, f.channels, s.rdb,
                        progress);
    case Method::gather:
      return render_gather(*session, f.width, f.height, f.coc_quanta, f.channels, s.gather,
                           progress);
    default:
      return render_linear(*session, f.width, f.height, f.coc_quanta, f.channels, s.linear,
                           progress);
  }
}

}  // namespace defray
