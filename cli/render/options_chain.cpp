// The options of defray render that bring the ray distribution buffer closer to the truth.
#include "options/lens_rows.h"
#include "render/render_command.h"

namespace defray::cli {
namespace {

const WordTable<bool> switch_words{{"off", false}, {"on", true}};
const WordTable<Hidden> hidden_words{
    {"off", Hidden::off}, {"fill", Hidden::fill}, {"patterns", Hidden::patterns}};
const WordTable<Border> border_words{
    {"clamp", Border::clamp}, {"black", Border::black}, {"renormalise", Border::renormalise}};

WordTable<Quality> quality_words() {
  WordTable<Quality> words;
  for (const Quality quality : all_qualities) words.emplace_back(to_string(quality), quality);
  return words;
}

/// "preview: --rdb 6 --hidden fill --half-size on".
std::string about(Quality quality) {
  const ChainSettings s = settings_for(quality);
  const std::string hidden = word_of(s.hidden, hidden_words);
  return fmt::format("{}: --rdb {} --hidden {}{}", to_string(quality), s.cells_per_side, hidden,
                     s.half_size ? " --half-size on" : "");
}

}  // namespace

/// It says how many cells and pixels, whether there is something hidden, and how far to look for
/// patterns.
OptionRow quality_row(ChainSettings& s) {
  const auto is_heard = [&s](const Given& given) {
    const bool says_size = s.half_size && !given("--half-size");
    return !given("--rdb") || !given("--hidden") || s.hidden == Hidden::patterns || says_size;
  };
  return {
      "--quality",
      word<Quality>([&s](Quality quality) { s = settings_for(quality); }, quality_words(),
                    to_string(Quality::normal)),
      fmt::format("{}; {}; {}; {}, and twice as many repetitions of the picture looked at",
                  about(Quality::preview), about(Quality::draft), about(Quality::normal),
                  about(Quality::high)),
      {.scope = of_chain,
       .needs = {is_heard, "means nothing beside --rdb and this --hidden: they say all of it"}}};
}

OptionGroup chain_options(ChainSettings& s) {
  return {
      "Closer to the truth",
      {{"--hidden", word(s.hidden, hidden_words),
        "What lies behind near surfaces: off: nothing; fill: made up from what is around; "
        "patterns: "
        "and from where the picture repeats itself"},
       {"--half-size", word(s.half_size, switch_words),
        "Means of 2x2 pixels go through the lens, the detail of what is sharp is put back"},
       {"--split",
        word(s.split, switch_words),
        "Split anti-aliased pixels into what is in front and what is behind",
        {.needs = {[&s](const Given&) { return s.hidden != Hidden::off; },
                   "means nothing to --hidden off: without what lies behind no pixel is split"}}},
       {"--repair", word(s.repair, switch_words), "Repair depth that looks anti-aliased"},
       {"--highlights", word(s.highlights, WordTable<bool>{{"discs", true}, {"rays", false}}),
        "Small bright sources: discs of the aperture's shape, or rays like others"},
       {"--sparse", word(s.sparse, switch_words),
        "Where every circle is large find rays for a half or a quarter of the rows, interpolate "
        "the others"},
       {"--border", word(s.border, border_words),
        "Outside the data window: clamp: its edge goes on; black; renormalise: only known rays "
        "count"}},
      of_chain};
}

OptionGroup aperture_options(RenderCommand& job) {
  Aperture& a = job.chain.aperture;
  const Needs blades{[&a](const Given&) { return a.blades != 0; }, "goes with --blades"};
  const auto number = [&](double Aperture::*field) {
    return lens_value({[&a, field](double v) { a.*field = v; },
                       [field](FrameLens& lens, double v) { lens.aperture.*field = v; }},
                      &job.animated, fmt::format("{}", a.*field));
  };
  return {
      "Aperture",
      {{"--blades", value(a.blades), "Corners of the iris, 3 to 32; 0: a circle"},
       {"--blade-curvature",
        number(&Aperture::curvature),
        "0: straight; 1: a circle; below 0, to -1: hollow, from 4 blades on",
        {.field = "curvature", .needs = blades}},
       {"--blade-rotation",
        number(&Aperture::rotation_deg),
        "Degrees counter-clockwise, seen behind the focus; 0: a side on the right",
        {.field = "rotation_deg", .needs = blades}},
       {"--squeeze", number(&Aperture::squeeze),
        "Height of highlights over their width, 0.125 to 8; 2x anamorphic: 2"},
       {"--aperture-image",
        value(a.image),
        "A picture of the bokeh, as it shows behind the focus; black lets no light through",
        {.field = "aperture.image"}},
       {"--cats-eye", number(&Aperture::cats_eye),
        "Vignetting: offset of the lens rim at the corners, aperture radii, 0 to 1; 1 leaves 39 % "
        "of a corner's light"}},
      of_chain};
}

}  // namespace defray::cli
