#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/stopwatch.h"
#include "defray/defray.h"
#include "image/nonfinite.h"
#include "lens/coc.h"
#include "lens/depth.h"
#include "library/backend_of.h"
#include "library/budget.h"
#include "library/lens_frame.h"
#include "library/transparent.h"
#include "methods/method.h"
#include "methods/tiltshift.h"
#include "prediction/with_error.h"

namespace defray {
namespace {

const char* const source = "the picture";  ///< For messages, where files have their names.

void check_plane(const char* what, std::span<const float> plane, const Window& data) {
  if (plane.size() == size(data.width) * size(data.height)) return;
  fail(ErrorKind::usage, "{} has {} values: the data window {} has {} pixels", what, plane.size(),
       to_string(data), size(data.width) * size(data.height));
}

void check(const Picture& picture, const Options& options) {
  const Window& data = picture.data;
  if (data.width <= 0 || data.height <= 0) {
    fail(ErrorKind::usage, "the data window {} has no pixels", to_string(data));
  }
  if (!has_allowed_size(data.width, data.height)) {
    fail(ErrorKind::usage,
         "the data window {} is too large: allowed are {} pixels a side and {} in all",
         to_string(data), max_side, max_pixels);
  }
  if (picture.display.width < 0 || picture.display.height < 0) {
    fail(ErrorKind::usage, "the display window {} has no pixels", to_string(picture.display));
  }
  if (picture.colour.empty() || picture.colour.size() > 4) {
    fail(ErrorKind::usage, "a picture has 1 to 4 planes of colour, not {}", picture.colour.size());
  }
  for (const auto& plane : picture.colour) check_plane("a plane of colour", plane, data);
  if (has_lens(options.method)) check_plane("the depth plane", picture.depth, data);
}

/// A view where every value is finite; else a copy in which handle_nonfinite has seen to them.
Values<float> colour_of(std::span<const float> plane, const Window& data, Nonfinite policy,
                        std::size_t& nonfinite) {
  if (std::all_of(plane.begin(), plane.end(), [](float v) { return std::isfinite(v); })) {
    return Values<float>::view(plane.data(), plane.size());
  }
  std::vector<Plane> copy{Plane(plane.begin(), plane.end())};
  nonfinite += handle_nonfinite(copy, policy, data, source);
  return std::move(copy.front());
}

Values<float> depth_of(const Picture& picture, const Window& display, const Lens& lens,
                       const DepthSettings& settings, DepthReport& report) {
  Plane depth(picture.depth.begin(), picture.depth.end());
  report = convert_depth(depth, settings, picture.data, display, lens, source);
  return depth;
}

/// As the lens takes it: copies only of what had to be changed.
Frame frame_of(const Picture& picture, const Lens& lens, const Options& options, Backend& backend,
               RenderReport& report) {
  PinholePicture pinhole;
  pinhole.data = picture.data;
  const bool has_display = picture.display.width > 0 && picture.display.height > 0;
  pinhole.display = has_display ? picture.display : picture.data;
  for (const auto& plane : picture.colour) {
    pinhole.channels.push_back(colour_of(plane, pinhole.data, options.nonfinite, report.nonfinite));
  }
  if (options.method == Method::tiltshift) {
    return lens_frame(std::move(pinhole), options.tiltshift, backend, report);
  }
  pinhole.depth = depth_of(picture, pinhole.display, lens, options.depth, report.depth);
  return lens_frame(std::move(pinhole), lens, backend, report);
}

void validate(const Lens& lens, const Options& options) {
  require_named("nonfinite", options.nonfinite, Nonfinite::keep);
  if (options.method == Method::tiltshift) return validate(options.tiltshift);
  validate(lens);
  validate(options.depth);
  if (options.method == Method::gather) validate(options.gather);
  validate(options, options.error);
  if (options.budget_ms) validate_budget(options, options.error, *options.budget_ms);
}

}  // namespace

RenderResult render(Device& device, const Picture& picture, const Lens& lens,
                    const Options& options, const Progress& progress) {
  check(picture, options);
  validate(lens, options);
  const Stopwatch watch;
  RenderResult out;
  Backend& backend = backend_of(device);
  const Frame frame = frame_of(picture, lens, options, backend, out.report);
  const std::string frame_class = class_of(frame, out.report);
  out.report.tuned = use_tuning(device, frame_class);
  std::optional<Budget> budget;
  if (options.budget_ms) {
    budget.emplace(device, frame_class, frame.pixels(), *options.budget_ms);
    out.report.budget = budget->choice();
  }
  const MethodSettings method = budget ? budget->settings(options) : MethodSettings(options);
  ResultWithError made =
      apply_with_error(frame, method, options.error, backend, options.wants_nearest, progress);
  MethodResult& result = made.result;
  out.report.expected = made.expected(options.error);
  if (made.prediction && options.error.wants_planes) {
    out.expected_error = made.prediction->planes();
  }
  out.report.chain = std::move(result.report);
  out.colour = std::move(result.colour);
  clear_transparent(frame, out.colour);
  out.coc_px = radii_px(frame.coc_quanta.host());
  out.confidence = std::move(result.confidence);
  out.nearest = std::move(result.nearest);
  if (budget) budget->learn(watch.seconds() - made.predict_seconds, *out.report.chain);
  return out;
}

const char* version() { return DEFRAY_VERSION; }

}  // namespace defray
