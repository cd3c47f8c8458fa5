#include "render/show_session.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "image/output.h"
#include "options/lens_rows.h"
#include "render/sequence_run.h"

namespace defray::cli {
namespace {

constexpr const char* keys =
    "keys: click, wheel, left and right or [ and ]: focus; control + wheel, down and up or - and "
    "+: "
    "f-number; space: before and after; c: CoC (red near, green in focus, blue far); 1: pixel for "
    "pixel; n, p: next, last frame; q: end";

constexpr double in_focus_px = 0.5;
constexpr double focus_step = 1.02, fstop_step = 1.122462048309373;  // a third of a stop

/// As a command line has it.
double rounded(double value) { return std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr); }

std::vector<Plane> in_rgb(std::vector<Plane> planes) {
  if (planes.size() <= 2) planes.insert(planes.begin(), 2, planes.front());
  return planes;
}

/// The picture, half of it the colour of its CoC: the larger, the stronger.
std::vector<Plane> with_coc(std::vector<Plane> planes, const Plane& coc_px) {
  float largest = static_cast<float>(in_focus_px);
  for (const float radius : coc_px) largest = std::max(largest, std::fabs(radius));
  for (std::size_t i = 0; i < coc_px.size(); ++i) {
    const float size = std::fabs(coc_px[i]);
    const std::size_t channel = size < in_focus_px ? 1 : coc_px[i] < 0 ? 0 : 2;
    const float strength = channel == 1 ? 1.0f : std::sqrt(size / largest);
    for (std::size_t c = 0; c < 3; ++c) planes[c][i] *= 0.5f;
    planes[channel][i] += 0.5f * strength;
  }
  return planes;
}

}  // namespace

ShowSession::ShowSession(const RenderCommand& job, std::vector<std::optional<int>> frames,
                         Device& device)
    : job_(job), frames_(std::move(frames)), device_(device), at_(frames_.size() - 1) {}

void ShowSession::run(const std::vector<Plane>& rendered) {
  read();
  find_lens();
  view_.after = in_rgb(rendered);
  fmt::print(stderr, "{}\n", keys);
  Viewer viewer("defray: " + job_.named(job_.paths.output), view_.display.width,
                view_.display.height);
  do {
    draw(viewer);
  } while (!handle(viewer.wait()));
}

void ShowSession::read() {
  const FramePaths paths = paths_of(job_.paths, frames_[at_]);
  file_.emplace(PictureFile::read(paths.input, job_.settings.request, paths.depth));
  const Picture& picture = file_->picture();
  view_.display = picture.display;
  std::vector<Plane> colour;
  for (const auto& plane : picture.colour) colour.emplace_back(plane.begin(), plane.end());
  view_.before = in_rgb(to_display_window(colour, picture.data, picture.display));
}

void ShowSession::find_lens() {
  view_.coc_px.clear();
  const FrameReport report = inspect_file(paths_of(job_.paths, frames_[at_]), settings());
  view_.lens = report.lens;
  view_.farthest_units = report.depth.farthest_units;
}

RenderSettings ShowSession::settings() const {
  RenderSettings s = settings_at(job_, frames_[at_]);
  if (place_ || focus_units_) {
    s.focus_at = place_;
    s.camera.focus_distance_units = focus_units_;
    s.camera.focus_end_units.reset();
  }
  if (fstop_) {
    s.camera.fstop = fstop_;
    s.camera.aperture_diameter_mm.reset();
  }
  return s;
}

void ShowSession::render() {
  find_lens();
  const RenderSettings s = settings();
  Options options;
  static_cast<MethodSettings&>(options) = s.method;
  if (options.chain) {
    const ChainSettings whole = *options.chain;
    options.chain = settings_for(Quality::preview);
    options.chain->aperture = whole.aperture;
    options.chain->border = whole.border;
  }
  options.tiltshift = s.tiltshift;
  options.depth = s.depth;
  options.nonfinite = s.nonfinite;
  const Picture& picture = file_->picture();
  const RenderResult result = defray::render(device_, picture, view_.lens, options);
  view_.after = in_rgb(to_display_window(result.colour, picture.data, picture.display));
  view_.coc_px = to_display_window({result.coc_px}, picture.data, picture.display).front();
}

void ShowSession::draw(Viewer& viewer) const {
  std::vector<Plane> planes = shows_before_ ? view_.before : view_.after;
  if (shows_coc_ && !view_.coc_px.empty()) planes = with_coc(std::move(planes), view_.coc_px);
  const std::string frame = frames_[at_] ? fmt::format(", frame {}", *frames_[at_]) : "";
  const std::string lens =
      has_lens() ? fmt::format(", focus {:.4g}, f/{:.4g}", view_.lens.focus_distance_units,
                               view_.lens.focal_length_mm / view_.lens.aperture_diameter_mm)
                 : "";
  viewer.show(planes, view_.display.width, view_.display.height, is_actual_size_,
              fmt::format("defray: {}{}{}{}{}", job_.named(job_.paths.output), frame, lens,
                          shows_before_ ? ", before" : "", shows_coc_ ? ", CoC" : ""));
}

bool ShowSession::handle(const ViewerEvent& event) {
  switch (event.kind) {
    case ViewerEvent::Kind::closed:
      return true;
    case ViewerEvent::Kind::click:
      if (!has_lens()) break;
      place_ = PixelPlace{event.x, event.y};
      focus_units_.reset();
      try {
        render();
      } catch (const Error& error) {  // background, or beside the data
        fmt::print(stderr, "defray: {}\n", message_of(error));
        place_.reset();
      }
      break;
    case ViewerEvent::Kind::wheel:
      if (!has_lens()) break;
      event.has_control ? change_fstop(event.steps) : change_focus(event.steps);
      break;
    case ViewerEvent::Kind::key:
      if (event.key == 'q' || event.key == key_escape) return true;
      handle_key(event.key);
      break;
  }
  return false;
}

void ShowSession::handle_key(int key) {
  if (key == ' ') shows_before_ = !shows_before_;
  if (key == '1') is_actual_size_ = !is_actual_size_;
  if (key == 'n') step(1);
  if (key == 'p') step(-1);
  if (key == 'c') {
    shows_coc_ = !shows_coc_;
    if (view_.coc_px.empty()) {
      const std::vector<Plane> rendered = view_.after;  // not by a preview
      render();
      view_.after = rendered;
    }
  }
  if (!has_lens()) return;
  if (key == key_left || key == '[') change_focus(-1);
  if (key == key_right || key == ']') change_focus(1);
  if (key == key_down || key == '-') change_fstop(-1);
  if (key == key_up || key == '+') change_fstop(1);
}

void ShowSession::change_focus(int steps) {
  const double now = view_.lens.focus_distance_units;
  const double from = std::isinf(now) ? view_.farthest_units : now;
  focus_units_ = rounded(from * std::pow(focus_step, steps));
  place_.reset();
  render();
}

void ShowSession::change_fstop(int steps) {
  if (view_.lens.aperture_diameter_mm == 0) return;
  const double now = view_.lens.focal_length_mm / view_.lens.aperture_diameter_mm;
  fstop_ = rounded(now * std::pow(fstop_step, steps));
  render();
}

void ShowSession::step(int frames) {
  const auto last = static_cast<std::ptrdiff_t>(frames_.size()) - 1;
  const auto next = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(at_) + frames, 0, last);
  if (next == static_cast<std::ptrdiff_t>(at_)) return;
  at_ = static_cast<std::size_t>(next);
  read();
  render();
}

std::string ShowSession::command() const {
  const bool has_focus = focus_units_ || place_;
  const auto is_replaced = [&](const std::string& name) {
    return name == "--show" || name == "--skip-existing" ||
           (has_focus && name.starts_with("--focus") && name != "--focus-setting") ||
           (fstop_ && (name == "--fstop" || name == "--aperture-diameter"));
  };
  const Given given = [&](const std::string& name) {
    if (name == "--focus" && has_focus) return true;
    if (name == "--fstop" && fstop_) return true;
    const auto is_it = [&](const auto& option) { return option.first == name; };
    return !is_replaced(name) && std::any_of(job_.given.begin(), job_.given.end(), is_it);
  };
  // render refuses what it would not hear.
  const auto is_left_out = [&](const std::string& name) {
    const bool is_camera = name == "--camera" || name == "--focus-setting";
    const bool is_eye = name == "--eye" || name.starts_with("--display-");
    return is_replaced(name) || (is_camera && !is_camera_heard(given)) ||
           (is_eye && has_optics(given));
  };
  std::string line = render_command_line(job_.given, is_left_out);
  if (focus_units_) line += fmt::format(" --focus {:.4g}", *focus_units_);
  if (place_) line += fmt::format(" --focus-at {},{}", place_->x, place_->y);
  if (fstop_) line += fmt::format(" --fstop {:.4g}", *fstop_);
  return line;
}

}  // namespace defray::cli
