#include "render_job.h"

namespace defray::cli {
namespace {

std::size_t memory_bytes(double mib) {
  if (!(mib > 0) || mib > 1048576) {
    fail(ErrorKind::usage, "--memory is {} MiB: allowed are numbers above 0, up to 1048576", mib);
  }
  return static_cast<std::size_t>(mib * 1048576);
}

}  // namespace

std::vector<OptionGroup> render_options(RenderJob& job) {
  return {main_options(job),
          file_options(job),
          channel_options(job),
          lens_options(job),
          method_options(job),
          stage_options(job.stages),
          aperture_options(job.stages.aperture),
          tiltshift_options(job.settings.tiltshift),
          device_options(job),
          terminal_options(job)};
}

void finish(RenderJob& job) {
  RenderSettings& s = job.settings;
  MethodSettings& m = s.method;
  m.rdb.memory_bytes = m.linear.memory_bytes = memory_bytes(job.memory_mib);
  if (m.method == Method::rdb && !job.is_literal) m.defocus = job.stages;
  make_lens_cells(m.rdb.cells_per_side, m.rdb.jitter);
  validate(job.stages.aperture);
  validate(m.gather);
  validate(s.tiltshift);
  validate(s.depth);
  if (m.method != Method::tiltshift) finish_lens(job);
}

}  // namespace defray::cli
