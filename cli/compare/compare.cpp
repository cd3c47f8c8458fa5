// defray compare: how far two pictures are apart.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "commands.h"
#include "compare/compare_report.h"
#include "exit_code.h"
#include "image/display.h"
#include "image/sequence.h"

namespace defray::cli {
namespace {

void validate(const CompareOptions& o) {
  const auto refuse_nan = [](const char* name, const std::optional<double>& value) {
    if (value && std::isnan(*value)) fail(ErrorKind::usage, "{} is not a number", name);
  };
  refuse_nan("--min-psnr", o.min_psnr);
  refuse_nan("--min-ssim", o.min_ssim);
  refuse_nan("--max-error", o.max_error);
  refuse_nan("--max-false-edges", o.max_false_edges);
  refuse_nan("--max-false-changes", o.max_false_changes);
  if (o.min_ssim && std::fabs(*o.min_ssim) > 1) {
    fail(ErrorKind::usage, "--min-ssim is {}: SSIM lies between -1 and 1", *o.min_ssim);
  }
  const auto refuse_negative = [](const char* name, const std::optional<double>& value) {
    if (value && *value < 0) fail(ErrorKind::usage, "{} is {}: it must be 0 or more", name, *value);
  };
  refuse_negative("--max-error", o.max_error);
  refuse_negative("--max-false-edges", o.max_false_edges);
  refuse_negative("--max-false-changes", o.max_false_changes);
  if (!(o.amplify > 0) || !std::isfinite(o.amplify)) {
    fail(ErrorKind::usage, "--amplify is {}: it must be a finite number above 0", o.amplify);
  }
  if (o.max_false_changes && !has_frame_pattern(o.a)) {
    fail(ErrorKind::usage, "--max-false-changes without a sequence: {} has no frame pattern (####)",
         o.a);
  }
}

void check_files(const CompareOptions& o) {
  if (!o.sheet.empty()) check_sheet(o.sheet, {o.a, o.b, o.depth, o.camera, o.mask});
}

/// Says which bounds are missed. A NaN is never good enough.
bool misses_a_bound(const CompareOptions& o, const Found& found, const std::string& where) {
  const Comparison& c = found.comparison;
  bool misses = false;
  const auto check = [&](const char* option, const std::optional<double>& bound, double value,
                         bool is_kept) {
    if (!bound || is_kept) return;
    std::string wanted = fmt::format("{:.6g}", *bound), found_is = fmt::format("{:.6g}", value);
    if (wanted == found_is) {
      wanted = fmt::format("{}", *bound);
      found_is = fmt::format("{}", value);
    }
    fmt::print(stderr, "defray: {}{} {} is missed: {}\n", where, option, wanted, found_is);
    misses = true;
  };
  check("--min-psnr", o.min_psnr, c.psnr_srgb_db, c.psnr_srgb_db >= o.min_psnr.value_or(0));
  check("--min-ssim", o.min_ssim, c.ssim, c.ssim >= o.min_ssim.value_or(0));
  check("--max-error", o.max_error, c.worst, c.worst <= o.max_error.value_or(0));
  const auto check_excess = [&](const char* option, const std::optional<double>& bound,
                                const std::optional<Excess>& excess) {
    if (excess) check(option, bound, excess->p999, excess->p999 <= bound.value_or(0));
  };
  check_excess("--max-false-edges", o.max_false_edges, found.false_edges);
  check_excess("--max-false-changes", o.max_false_changes, found.false_changes);
  return misses;
}

void write_difference(const CompareOptions& o, const Pair& pair) {
  const auto& [a, b] = pair;
  write_sheet(o.sheet,
              {{"A: " + o.a, a.planes},
               {"B: " + o.b, b.planes},
               {fmt::format("|A - B| x {:g}", o.amplify),
                difference_picture(a.planes, b.planes, o.amplify)}},
              a.data.width, a.data.height);
}

/// The frames that both sequences have; none: two pictures.
std::vector<int> frames_of(const CompareOptions& o) {
  const bool is_a = has_frame_pattern(o.a), is_b = has_frame_pattern(o.b);
  if (is_a != is_b) {
    fail(ErrorKind::usage, "{} is a sequence, {} one picture: compare two of a kind",
         is_a ? o.a : o.b, is_a ? o.b : o.a);
  }
  if (!is_a) {
    if (!o.frames.empty()) {
      fail(ErrorKind::usage, "--frames without a sequence: {} has no frame pattern (####)", o.a);
    }
    return {};
  }
  if (!o.sheet.empty() && !has_frame_pattern(o.sheet)) {
    fail(ErrorKind::usage, "--sheet {}: of a sequence, its name needs a frame pattern (####)",
         o.sheet);
  }
  return o.frames.empty() ? find_frames(o.a) : parse_frames(o.frames);
}

/// Compares, says what it found, and whether a bound was missed.
class Comparing {
 public:
  explicit Comparing(const CompareOptions& options) : options_(options) {}

  void frame(std::optional<int> number) {
    const CompareOptions o = number ? options_.of_frame(*number) : options_;
    check_files(o);
    Pair pair = read_pair(o);
    found_.push_back(compare_pair(o, pair, before_ ? &*before_ : nullptr));
    o.json ? print_json(found_.back(), number) : print_text(found_.back(), number);
    if (!o.sheet.empty()) write_difference(o, pair);
    const std::string where = number ? fmt::format("frame {}: ", *number) : "";
    if (misses_a_bound(o, found_.back(), where)) misses_ = true;
    before_ = std::move(pair);
  }

  const std::vector<Found>& found() const { return found_; }
  bool misses() const { return misses_; }

 private:
  const CompareOptions& options_;
  std::optional<Pair> before_;
  std::vector<Found> found_;
  bool misses_ = false;
};

int run(const CompareOptions& o) {
  validate(o);
  const std::vector<int> frames = frames_of(o);
  Comparing comparing(o);
  if (frames.empty()) comparing.frame({});
  for (const int frame : frames) comparing.frame(frame);
  if (!o.json && !frames.empty()) print_summary(comparing.found(), frames);
  return comparing.misses() ? ExitCode::failed : ExitCode::ok;
}

/// --depth.
void add_edge_band(CLI::App* command, const std::shared_ptr<CompareOptions>& o) {
  auto* depth = command->add_option(
      "--depth", o->depth, "Planar depth in metres: also give the errors in the edge band");
  auto* camera = command->add_option("--camera", o->camera, "camera.json: the lens, for --depth");
  depth->needs(camera);
  camera->needs(depth);
  command->add_option("--depth-channel", o->depth_channel, "Which channel of the depth file")
      ->needs(depth);
  command->add_option("--focus-setting", o->focus_setting, "Which of the camera's focus settings")
      ->needs(camera);
  command
      ->add_option("--edge-step", o->edge_step,
                   "An edge is where neighbours' depths differ by more than this share")
      ->needs(depth);
}

void add_false_edges(CLI::App* command, const std::shared_ptr<CompareOptions>& o) {
  auto* edges = command->add_flag(
      "--false-edges", o->false_edges,
      "Edges that B has not, 255ths a pixel; of sequences, changes from frame to frame, too");
  command
      ->add_option("--max-false-edges", o->max_false_edges,
                   "Exit with 1 if their 99.9th percentile is above this, 255ths a pixel")
      ->needs(edges);
  command
      ->add_option("--max-false-changes", o->max_false_changes,
                   "The same of changes from frame to frame, 255ths")
      ->needs(edges);
}

}  // namespace

Run add_compare(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "compare", "Compare two pictures: PSNR, SSIM, worst pixel, errors near depth edges");
  auto o = std::make_shared<CompareOptions>();
  command->add_option("a", o->a, "Picture, or a sequence: a.####.exr")->required();
  command->add_option("b", o->b, "Picture of the same size, for instance the truth")->required();
  command->add_option("--frames", o->frames,
                      "Of sequences: 1-8, 1-10x2, 1,5,9-12; without, all that A has");
  command->add_option("--min-psnr", o->min_psnr, "Exit with 1 below this PSNR, dB, sRGB-encoded");
  command->add_option("--min-ssim", o->min_ssim, "Exit with 1 below this SSIM, -1 to 1");
  command->add_option("--max-error", o->max_error,
                      "Exit with 1 if a linear value differs by more than this");
  add_edge_band(command, o);
  command->add_option(
      "--windows", o->windows,
      "Where data windows differ: union, 0 where a picture has nothing, or overlap");
  command->add_option("--crop", o->crop, "Only this part, 320x200+100+50, of the display window");
  command->add_option("--mask", o->mask, "Only where this picture's first channel is above a half");
  add_false_edges(command, o);
  auto* sheet = command->add_option("--sheet", o->sheet,
                                    "Write A, B and their difference side by side, PNG or JPEG");
  command->add_option("--amplify", o->amplify, "The sheet's difference is this many times as dark")
      ->needs(sheet);
  command->add_flag("--json", o->json, "Print one JSON object a line, one a frame");
  command->footer(
      "The edge band: pixels within the CoC radius (of the more blurred surface) plus 1 px of a "
      "depth edge.\n"
      "Depth is planar, in metres: 'defray render' reads other kinds, this command does not.\n"
      "A false edge: a gradient of A's sRGB-encoded luma (central differences) above the largest\n"
      "that B has within 2 px; a false change: the same of the difference to the frame before.\n"
      "Examples:\n"
      "  defray compare out.exr truth.exr --min-psnr 35 --sheet difference.png\n"
      "  defray compare out.exr truth.exr --depth pinhole.exr --camera camera.json\n"
      "  defray compare 'out.####.exr' 'truth.####.exr' --false-edges");
  return [o] { return run(*o); };
}

}  // namespace defray::cli
