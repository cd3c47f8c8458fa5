// The options of defray render that bring the ray distribution buffer closer to the truth.
#include "options.h"
#include "render.h"

namespace defray::cli {
void add_defocus_options(CLI::App& c, RenderOptions& o) {
  const char* const group = "Closer to the truth (rdb)";
  c.add_option(
       "--quality", o.quality,
       "draft: --rdb 9 --hidden smooth; normal (default): --rdb 13; high: --rdb 33, and twice "
       "as many repetitions of the picture looked at")
      ->group(group);
  c.add_option(
       "--hidden", o.hidden,
       "What lies behind near surfaces: off: nothing; smooth: made up from what is around; on "
       "(default): and from where the picture repeats itself")
      ->group(group);
  c.add_option("--edges", o.edges,
               "Anti-aliased pixels: split (default) into what is in front and behind, or keep")
      ->group(group);
  c.add_flag("--keep-depth", o.keep_depth, "Do not repair depth that looks anti-aliased")
      ->group(group);
  c.add_option("--highlights", o.highlights,
               "Small bright sources: discs (default) of the aperture's shape, or rays like others")
      ->group(group);
  c.add_option("--border", o.border,
               "Outside the data window: clamp (default): its edge goes on; black; renormalise: "
               "only known rays count")
      ->group(group);
  add_aperture_options(c, o.aperture);
}

ChainSettings to_chain(const RenderOptions& o) {
  ChainSettings s = settings_for(choice<Quality>(
      "--quality", o.quality.empty() ? "normal" : o.quality,
      {{"draft", Quality::draft}, {"normal", Quality::normal}, {"high", Quality::high}}));
  if (o.rdb) s.cells_per_side = *o.rdb;
  if (!o.hidden.empty()) {
    s.hidden =
        choice<Hidden>("--hidden", o.hidden,
                       {{"off", Hidden::off}, {"smooth", Hidden::smooth}, {"on", Hidden::on}});
  }
  if (!o.edges.empty()) {
    s.split_edges = choice<bool>("--edges", o.edges, {{"split", true}, {"keep", false}});
  }
  if (!o.highlights.empty()) {
    s.highlights = choice<bool>("--highlights", o.highlights, {{"discs", true}, {"rays", false}});
  }
  if (!o.border.empty()) {
    s.border = choice<Border>(
        "--border", o.border,
        {{"clamp", Border::clamp}, {"black", Border::black}, {"renormalise", Border::renormalise}});
  }
  s.repair_depth = !o.keep_depth;
  s.aperture = to_aperture(o.aperture);
  return s;
}

}  // namespace defray::cli
