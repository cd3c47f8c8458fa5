#include "prediction/with_error.h"

#include <algorithm>

#include "base/error.h"
#include "base/stopwatch.h"
#include "chain/quality.h"

namespace defray {
namespace {

/// Where it is asked for, and can be.
void predict(const Frame& frame, const ErrorSettings& error, ResultWithError& out) {
  if (!(error.wants_expected || error.target_db) || !is_predictable(out.settings)) return;
  const Stopwatch watch;
  out.prediction.emplace(frame, *out.settings.chain, out.result, error.wants_planes);
  out.predict_seconds += watch.seconds();
}

// What is guessed of other rungs, minus what was found of them, on 17 settings of ten built-in
// scenes, dB: from preview 0.3 in the median and -0.1 to 0.9 in eight of ten, from a picture of
// full size -0.03 to 0.03. So the first may be believed up to the default, no further.
constexpr double preview_margin_db = 0.5, margin_db = 0.05;

/// The next rung that is likely to reach the target, the last if none is; past the last from it.
std::size_t next_rung(std::size_t rung, const Prediction& prediction, const ChainSettings& chain,
                      double target_db) {
  const auto& all = rungs();
  const Rung normal{Quality::normal, settings_for(Quality::normal).cells_per_side};
  const bool is_preview = all[rung].quality == Quality::preview;
  const auto last = is_preview ? std::find(all.begin(), all.end(), normal) : all.end() - 1;
  const double enough_db = target_db + (is_preview ? preview_margin_db : margin_db);
  auto next = all.begin() + static_cast<std::ptrdiff_t>(rung) + 1;
  while (next < last && prediction.guess_db(with_rung(chain, *next)) < enough_db) ++next;
  return static_cast<std::size_t>(next - all.begin());
}

/// The rung to begin with.
std::size_t first_rung(const ErrorSettings& error) {
  if (!error.first_quality) return 0;
  const Rung wanted{*error.first_quality, error.first_cells_per_side};
  const auto found = std::find(rungs().begin(), rungs().end(), wanted);
  return found == rungs().end() ? 0 : static_cast<std::size_t>(found - rungs().begin());
}

// Work of a rung, in lens points of a picture of full size: what does not depend on them, and them.
// (The accuracy table: of fence bg 75, 134 and 323, of spheres f3 93, 160 and 386.)
constexpr double preview_work = 80, draft_work = 150, normal_work = 350;
/// A sequence changes to what takes less than half the work if it is likely to do, and to what
/// takes less than three quarters if it is likely to do for the frames to come as well: no sooner,
/// as what changes flickers. (`drift` in 480x300, 12 frames, targets of 36.5, 38.5 and 40 dB: with
/// no margin of its own for the latter the quality changes up to 5 times, with it up to 2.)
constexpr double far_less = 0.5, worth_a_change = 0.75, lasting_margin_db = 0.25;

double work_of(const Rung& rung) {
  if (rung.quality == Quality::preview) return preview_work;
  return (rung.quality == Quality::draft ? draft_work : normal_work) +
         rung.cells_per_side * rung.cells_per_side;
}

/// What the frame after one of this rung begins with.
Rung rung_after(const Rung& rung, const Prediction& prediction, const ChainSettings& chain,
                double target_db) {
  for (const Rung& less : rungs()) {
    const double share = work_of(less) / work_of(rung);
    if (less == rung || share > worth_a_change) continue;
    const double margin = less.quality == Quality::preview ? preview_margin_db
                          : share > far_less               ? lasting_margin_db
                                                           : margin_db;
    if (prediction.guess_db(with_rung(chain, less)) >= target_db + margin) return less;
  }
  return rung;
}

}  // namespace

std::optional<ExpectedError> ResultWithError::expected(const ErrorSettings& wanted) const {
  if (!prediction) return {};
  ExpectedError expected = prediction->of_frame();
  if (rung) {
    expected.quality = rung->quality;
    expected.cells_per_side = rung->cells_per_side;
    expected.next_quality = next_rung->quality;
    expected.next_cells_per_side = next_rung->cells_per_side;
  }
  expected.misses_target = wanted.target_db && expected.psnr_db < *wanted.target_db;
  return expected;
}

bool is_predictable(const MethodSettings& method) {
  if (method.method != Method::rdb || !method.chain) return false;
  const ChainSettings& s = *method.chain;
  return s.hidden != Hidden::off && s.border == Border::clamp && s.split && s.highlights &&
         s.cells_per_side >= settings_for(Quality::preview).cells_per_side;
}

void validate(const MethodSettings& method, const ErrorSettings& error) {
  validate(method);
  const char* const asked = error.target_db ? "target_db" : error.wants_planes ? "error" : nullptr;
  if (!asked) return;
  if (error.target_db && !(*error.target_db > 0 && *error.target_db <= most_expected_db)) {
    fail(ErrorKind::usage, "{} is {}: a PSNR in dB, allowed are more than 0 to {}",
         field("target_db"), *error.target_db, most_expected_db);
  }
  MethodSettings with_any_quality = method;
  if (error.target_db && method.chain) {
    with_any_quality.chain = with_rung(*method.chain, rungs().front());
  }
  if (is_predictable(with_any_quality)) return;
  fail(ErrorKind::usage,
       "{}: errors are expected of the ray distribution buffer with its stages alone, {} fill or "
       "patterns, {} clamp, {} and {} on, {} from {}",
       field(asked), field("hidden"), field("border"), field("split"), field("highlights"),
       field("cells_per_side"), settings_for(Quality::preview).cells_per_side);
}

ResultWithError apply_with_error(const Frame& frame, const MethodSettings& settings,
                                 const ErrorSettings& error, Backend& backend, bool wants_nearest,
                                 const Progress& progress) {
  validate(settings, error);
  ResultWithError out{{}, settings, {}, {}};
  if (!error.target_db) {
    out.result = apply_method(frame, settings, backend, wants_nearest, progress);
    predict(frame, error, out);
    return out;
  }
  for (std::size_t rung = first_rung(error); rung < rungs().size();) {
    out.settings.chain = with_rung(*settings.chain, rungs()[rung]);
    const auto of_all = [&](double share) {
      progress((static_cast<double>(rung) + share) / static_cast<double>(rungs().size()));
    };
    out.result = {}, out.prediction.reset();  // the last one's planes
    out.result = apply_method(frame, out.settings, backend, wants_nearest,
                              progress ? Progress(of_all) : Progress());
    predict(frame, error, out);
    out.rung = rungs()[rung];
    if (out.prediction->of_frame().psnr_db >= *error.target_db) break;
    rung = next_rung(rung, *out.prediction, *settings.chain, *error.target_db);
  }
  out.next_rung = rung_after(*out.rung, *out.prediction, *settings.chain, *error.target_db);
  if (progress) progress(1);
  return out;
}

}  // namespace defray
