#include "options/lens_rows.h"
#include "options/parse.h"
#include "splat/splat_command.h"

namespace defray::cli {
namespace {

/// A frame each 13 seconds of arc: more is a mistake, and each takes memory before the first is
/// drawn.
constexpr std::int64_t most_turn_frames = 100000;

const WordTable<bool> on_off_words{{"on", true}, {"off", false}};
const WordTable<SplatPsf> psf_words{{"gaussian", SplatPsf::gaussian}, {"disc", SplatPsf::disc}};
const WordTable<SplatMerge> merge_words{{"nearest", SplatMerge::nearest},
                                        {"average", SplatMerge::average}};

OptionValue place(std::optional<std::array<double, 3>>& target) {
  const auto read = std::make_shared<std::string>();
  return {[read](CLI::App& c, const std::string& name) {
            return c.add_option(name, *read)->type_name("X,Y,Z");
          },
          [read, &target](const OptionText& o) { target = parse_point(o.name, *read); }, ""};
}

OptionGroup main_rows(SplatCommand& job) {
  return {"",
          {{"input", value(job.input), "Point cloud: .ply, or text (.xyz .txt .csv .pts)"},
           {"--model",
            value(job.model),
            "A built-in model instead: plane, figure, crossing, mask",
            {.needs = {[](const Given& given) { return !given("input"); },
                       "stands instead of a file"}}},
           {"--model-points",
            parsed<std::int64_t>(
                [&job](std::int64_t points) {
                  if (points < 1) {
                    fail(ErrorKind::usage, "--model-points is {}: allowed are 1 on", points);
                  }
                  job.model_points = static_cast<std::size_t>(points);
                },
                "the model's own"),
            "About how many points it has",
            {.needs = {[](const Given& given) { return given("--model"); }, "goes with --model"}}},
           {"--cache",
            flag(job.has_cache),
            "Keep what is made of the file beside it, as FILE.surfels, for the next time",
            {.needs = {[](const Given& given) { return given("input"); }, "goes with a file"}}},
           {"-o,--output",
            value(job.output),
            "Picture; a turn needs #### in its name",
            {.is_required = true}}}};
}

OptionGroup view_rows(SplatCommand& job) {
  SplatSettings& s = job.settings;
  return {
      "View",
      {{"--size",
        parsed<std::string>(
            [&s](const std::string& text) {
              const Window window = parse_size("--size", text);
              s.width = window.width;
              s.height = window.height;
            },
            fmt::format("{}x{}", s.width, s.height)),
        "Pixels"},
       {"--from", with_default(place(job.from), "far enough to see all"),
        "Where the camera stands, scene units"},
       {"--look-at", with_default(place(job.look_at), "the cloud's middle"), "What it looks at"},
       {"--up", with_default(place(job.up), "0,1,0"), "What is up in the picture"},
       {"--turntable", parsed<std::int64_t>([&job](std::int64_t frames) {
          if (frames < 1 || frames > most_turn_frames) {
            fail(ErrorKind::usage, "--turntable is {}: allowed are 1 to {}", frames,
                 most_turn_frames);
          }
          job.turntable = static_cast<int>(frames);
        }),
        "So many frames of a turn around what is looked at"},
       {"--frames", with_default(value(job.frames), "the turn's, or every --camera that matches"),
        "1-8, 1-10x2, 1,5,9-12"},
       {"--unit",
        parsed<std::string>(
            [&job](const std::string& text) { job.metres_per_unit = parse_unit(text); },
            unit_of(job.metres_per_unit)),
        "Scene unit: m, cm, mm, km, ft, in, or its length in metres",
        {.field = "metres_per_unit"}}}};
}

OptionGroup lens_group(SplatCommand& job) {
  OptionGroup group{
      "Lens", lens_rows(job.camera, "scene units; without one, what is looked at", &job.animated)};
  const auto add = [&](std::vector<OptionRow> rows) {
    group.rows.insert(group.rows.end(), rows.begin(), rows.end());
  };
  add(sensor_rows(job.camera, &job.animated));
  add(eye_rows(job.eye, job.animated));
  add(scale_rows(job.camera, job.animated));
  std::vector<OptionRow> camera = camera_rows(job.camera_file, job.focus_setting, "");
  camera.front().details.needs = {};  // whatever the lens, it says where the camera stands
  add(camera);
  add({max_coc_row(job.max_coc_px, job.animated)});
  return group;
}

OptionGroup splat_rows(SplatCommand& job) {
  SplatSettings& s = job.settings;
  return {
      "Splats",
      {{"--lod", word(s.lod, on_off_words),
        "Nodes of a hierarchy stand for points that blur, or their size, hides"},
       {"--cutoff", value(s.cutoff), "Where Gaussians end: where they are down to e^-c, 2 to 3"},
       {"--psf", word(s.psf, psf_words),
        "Light over the circle of confusion: evenly, as the lens's points see it, or as the "
        "paper's Gaussian"},
       {"--merge", word(s.merge, merge_words),
        "Surfaces too close to be told apart: the nearest counts, or, as the paper has it, their "
        "average"},
       {"--layers", value(s.layers),
        "Surfaces that a pixel is made of at most, the nearest (the depth of its A-buffer); 0: "
        "all. A note says what it leaves out"},
       {"--two-sided", flag(s.two_sided),
        "Surfaces are seen from behind, too (always where they are open and have no normals)"},
       {"--transparency", value(s.transparency), "What all points let through, 0 to below 1"}}};
}

OptionGroup output_rows(SplatCommand& job) {
  return {
      "Output",
      {{"--depth", flag(job.has_depth),
        "Also channel Z: the depth of the nearest surface, inf where there is none"},
       {"--fragments", flag(job.has_fragments),
        "Also channel fragments: how many splats a pixel was made of"},
       {"--mkdir", flag(job.makes_folders), "Make the pictures' folder where there is none"},
       {"--skip-existing", flag(job.skip_existing),
        "Leave frames alone whose pictures exist and are not empty"},
       {"--device", value(job.device), "Index or part of the name of 'defray devices'; reference"},
       {"--no-tuning", flag(job.no_tuning),
        "Do not use the work-groups that 'defray tune' found: the same picture"},
       {"--json", flag(job.json), "One JSON line a frame instead of text"},
       {"-q,--quiet", flag(job.quiet), quiet_help},
       {"--show", flag(job.show), "Show the last picture in a window; q closes it"}}};
}

}  // namespace

std::vector<OptionGroup> splat_options(SplatCommand& job) {
  return {main_rows(job), view_rows(job), lens_group(job), splat_rows(job), output_rows(job)};
}

}  // namespace defray::cli
