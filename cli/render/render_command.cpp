#include "render/render_command.h"

#include "lens/depth.h"
#include "lens/lens_grid.h"
#include "library/budget.h"
#include "methods/tiltshift.h"
#include "options/lens_rows.h"
#include "options/shell_quoted.h"
#include "prediction/with_error.h"

namespace defray::cli {
std::size_t RenderCommand::memory_bytes() const {
  if (!(memory_mib > 0) || memory_mib > 1048576) {
    fail(ErrorKind::usage, "--memory is {} MiB: allowed are numbers above 0, up to 1048576",
         memory_mib);
  }
  return static_cast<std::size_t>(memory_mib * 1048576);
}

std::vector<Method> lens_methods() {
  std::vector<Method> methods = all_methods();
  std::erase_if(methods, [](Method method) { return !has_lens(method); });
  return methods;
}

std::vector<OptionGroup> render_options(RenderCommand& job) {
  return {main_options(job),     file_options(job),
          channel_options(job),  lens_options(job),
          method_options(job),   chain_options(job.chain),
          aperture_options(job), tiltshift_options(job.settings.tiltshift),
          device_options(job),   terminal_options(job)};
}

void finish(RenderCommand& job) {
  RenderSettings& s = job.settings;
  MethodSettings& m = s.method;
  job.memory_bytes();  // before anything is read
  m.chain.reset();
  if (m.method == Method::rdb && !job.is_literal) m.chain = job.chain;
  make_lens_grid(m.rdb.cells_per_side, m.rdb.jitter);
  validate(job.chain.aperture);
  validate(m.gather);
  validate(s.tiltshift);
  validate(s.depth);
  s.camera_from_metadata = job.camera == from_metadata;
  validate(m, {false, !job.paths.error.empty(), s.error.target_db});
  if (s.budget_ms) validate_budget(m, s.error, *s.budget_ms);
  s.error.wants_expected = job.json || !job.quiet;
}

std::string render_command_line(const std::vector<std::pair<std::string, std::string>>& given,
                                const std::function<bool(const std::string&)>& is_left_out) {
  std::string line = "defray render";
  for (const auto& [name, values] : given) {
    if (is_left_out(name)) continue;
    if (!name.empty()) line += " " + name;
    if (!values.empty()) line += " " + shell_quoted(values);
  }
  return line;
}

}  // namespace defray::cli
