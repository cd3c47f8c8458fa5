// The files, channels and depth of defray render.
#include "image/further_channels.h"
#include "render/render_command.h"

namespace defray::cli {
namespace {

const WordTable<DepthKind> depth_words{{"z", DepthKind::z},
                                       {"distance", DepthKind::distance},
                                       {"inverse", DepthKind::inverse},
                                       {"normalized", DepthKind::normalized},
                                       {"negative-z", DepthKind::negative_z},
                                       {"zbuffer", DepthKind::zbuffer}};
const WordTable<Bits> bits_words{
    {"8", Bits::eight}, {"16", Bits::sixteen}, {"half", Bits::half}, {"float", Bits::single}};
const WordTable<Grow> grow_words{
    {"none", Grow::none}, {"display", Grow::display}, {"full", Grow::full}};
const WordTable<Nonfinite> nonfinite_words{
    {"error", Nonfinite::error}, {"zero", Nonfinite::zero}, {"keep", Nonfinite::keep}};
const Scope of_depth{.methods = lens_methods()};

std::vector<OptionRow> depth_rows(RenderSettings& s) {
  DepthSettings& d = s.depth;
  const Needs range{[&d](const Given&) {
                      return d.kind == DepthKind::normalized || d.kind == DepthKind::zbuffer;
                    },
                    "goes with --depth-kind normalized or zbuffer only"};
  const Needs ends{[&d](const Given& given) {
                     return d.kind != DepthKind::normalized || (given("--near") && given("--far"));
                   },
                   "normalized needs --near, which may be 0, and --far, in scene units"};
  return {
      {"--depth-kind",
       word(d.kind, depth_words),
       "z: planar; distance: along the ray; inverse: 1/z; normalized: 0 near, 1 far; negative-z: "
       "-z of camera space; zbuffer: as a GPU stores it, 0 near, 1 far, linear in 1/z",
       {.field = "depth.kind", .scope = of_depth, .needs = ends}},
      {"--near",
       with_default(value(d.near_units), ""),
       "Depth of 0, scene units (normalized, where it may be 0; zbuffer)",
       {.field = "near_units", .scope = of_depth, .needs = range}},
      {"--far",
       with_default(value(d.far_units), ""),
       "Depth of 1, scene units (normalized; zbuffer, where it may be inf)",
       {.field = "far_units", .scope = of_depth, .needs = range}},
      {"--invert",
       flag(d.invert),
       "1 is near, 0 is far (normalized; zbuffer: reversed)",
       {.scope = of_depth, .needs = range}},
      {"--unit",
       parsed<std::string>([&s](const auto& text) { s.metres_per_unit = parse_unit(text); },
                           unit_of(s.metres_per_unit)),
       "Scene unit: m, cm, mm, km, ft, in, or its length in metres",
       {.field = "metres_per_unit", .scope = of_depth}},
      {"--background",
       parsed<std::string>([&d](const auto& text) { d.background = parse_background(text); },
                           "65504, >= 1e9, inf, <= 0"),
       "Stored depth that means background, or none",
       {.scope = of_depth}},
  };
}

}  // namespace

OptionGroup main_options(RenderCommand& job) {
  return {
      "",
      {{"input",
        value(job.paths.input),
        "Colour, and depth unless --depth is given; #### or %04d: frames; -: standard input",
        {.is_required = true}},
       {"-o,--output",
        value(job.paths.output),
        "EXR, TIFF, HDR (linear), PNG, JPEG (sRGB-encoded); -: standard output, EXR or as a PNG "
        "input",
        {.field = "output", .is_required = true}}}};
}

OptionRow full_size_row(RenderCommand& job) {
  return {"--full-size",
          parsed<std::string>([&job](const auto& text) {
            job.settings.full_size = parse_window("--full-size", text);
          }),
          "The picture is cut out of a frame of this size, 3840x2160+100+50: what the lens's field "
          "of view spans",
          {.field = "full_size", .scope = Scope{.methods = lens_methods()}}};
}

OptionGroup file_options(RenderCommand& job) {
  return {
      "Files",
      {{"--depth", value(job.paths.depth), "Take depth from this file", {.scope = of_depth}},
       {"--coc-out",
        value(job.paths.coc),
        "Write the signed CoC radius in px (.exr, .tif)",
        {.field = "coc"}},
       {"--confidence-out",
        value(job.paths.confidence),
        "Write the share of each pixel's lens rays that the input determines (.exr, .tif)",
        {.field = "confidence", .scope = of_chain}},
       {"--error-out",
        value(job.paths.error),
        "Write the RMS error of sRGB-encoded values that is expected at each pixel, in all and by "
        "cause (.exr, .tif): total, sampling, hidden, edges, detail",
        {.field = "error", .scope = of_chain}},
       {"--tiles-out",
        value(job.paths.tiles),
        "Write what each tile of 16 px holds: 0 in focus, 1 smooth, 2 mixed, 3 hidden surfaces, "
        "4 lights (.exr, .tif)",
        {.field = "tiles", .scope = of_chain}},
       {"--compression",
        with_default(value(job.settings.compression), "the input's"),
        "Of what is written: none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab (EXR), none, "
        "lzw, zip, packbits (TIFF); pxr24, b44 and dwa lose a little",
        {.field = "compression"}},
       {"--bits",
        with_default(word<Bits>([&job](Bits bits) { job.settings.bits = bits; }, bits_words, ""),
                     "the input's; 8 from floats to PNG"),
        "Of a channel of the output: 8, 16 (PNG, TIFF), half (EXR), float (EXR, TIFF)",
        {.field = "bits"}},
       {"--grow",
        word<Grow>([&job](Grow grow) { job.settings.grow = grow; }, grow_words,
                   "display where alpha is below 1 somewhere, else none"),
        "How far a data window grows by the blur of what lies in it: not at all, up to the display "
        "window, beyond",
        {.scope = of_depth}},
       full_size_row(job),
       {"--mkdir",
        flag(job.settings.make_folders),
        "Make the outputs' folders where there are none",
        {.field = "make_folders"}},
       {"--no-pattern", flag(job.no_pattern), "No name is a pattern: #, @ and %d are letters"},
       {"--frames", with_default(value(job.frames), "every file that matches"),
        "1-8, 1-10x2, 1,5,9-12"},
       {"--skip-existing", flag(job.skip_existing),
        "Leave frames alone whose outputs all exist, none of them empty"},
       {"--skip-bad-frames", flag(job.skip_bad_frames),
        "Report a frame that fails, go on, exit with 1 at the end"},
       {"--no-overlap", flag(job.no_overlap),
        "Read, render and write one frame after the other: less memory"}}};
}

OptionGroup channel_options(RenderCommand& job) {
  RenderSettings& s = job.settings;
  OptionGroup group{
      "Channels and depth",
      {{"--layer", value(s.request.layer), "Colour layer, 'ViewLayer.Combined'"},
       {"--view", value(s.request.view), "Stereo view, 'left'"},
       {"--depth-channel",
        value(s.request.depth_channel),
        "Depth channel by its full name, 'depth.Z', or with its part's before it, 'depth_left.Z'",
        {.scope = of_depth}},
       {"--channels",
        parsed<std::string>([&s](const auto& list) { s.channels = parse_channel_list(list); }),
        "Further channels for the lens, 'diffuse.*,N.*': light is averaged as colour is; data gets "
        "the value of the nearest hit. Data: " +
            data_channel_rules(),
        {.scope = Scope{{Method::rdb}}}}}};
  for (OptionRow& row : depth_rows(s)) group.rows.push_back(std::move(row));
  group.rows.push_back(
      {"--nonfinite", word(s.nonfinite, nonfinite_words), "What becomes of NaN and Inf colours"});
  return group;
}

OptionGroup terminal_options(RenderCommand& job) {
  return {"Output to the terminal",
          {{"--json", flag(job.json), "One JSON line a frame instead of text"},
           {"--stats",
            flag(job.stats),
            "Also each stage's time and memory, and what the tiles hold",
            {.scope = of_chain,
             .needs = {[&job](const Given&) { return !job.json && !job.quiet; },
                       "goes without --json, which has it all, and without --quiet"}}},
           {"-q,--quiet", flag(job.quiet), quiet_help},
           {"--show", flag(job.show),
            "Show the last picture in a window; keys and mouse change focus and f-number, q ends "
            "and prints "
            "the command"}}};
}

}  // namespace defray::cli
