// All passes of the gather's twins.
#include "methods/gather.h"

#include "reference/reference.h"
#include "reference/stage_frame.h"

namespace defray::reference {

Planes TwinBackend::gather(const Frame& f, const GatherSettings& settings, const Progress&) {
  validate(settings);
  const GatherSamples samples = make_gather_samples(settings);
  std::vector<Plane> result = planes_of(f.channels);
  for (int pass = 0; pass < settings.passes; ++pass) {
    const DefrayGatherParams p = gather_params(settings, f.width, pass);
    result = settings.kind == GatherKind::literal ? gather_literal(p, samples, result, f)
                                                  : gather_aware(p, samples, result, f);
  }
  return result;
}

}  // namespace defray::reference
