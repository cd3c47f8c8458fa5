// All passes of the gather's twins.
#include "methods/gather.h"

#include "reference/reference.h"

namespace defray::reference {

std::vector<Plane> render_gather(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                                 const std::vector<Plane>& channels,
                                 const GatherSettings& settings) {
  validate(settings);
  const GatherSamples samples = make_gather_samples(settings);
  std::vector<Plane> result = channels;
  for (int pass = 0; pass < settings.passes; ++pass) {
    const DefrayGatherParams p = gather_params(settings, width, height, pass);
    result = settings.kind == GatherKind::literal ? gather_literal(p, samples, coc_quanta, result)
                                                  : gather_aware(p, samples, coc_quanta, result);
  }
  return result;
}

}  // namespace defray::reference
