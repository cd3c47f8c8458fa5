#pragma once
// The lens, of every command that has one.
#include <string>
#include <vector>

#include "defray/lens.h"
#include "options/curve.h"
#include "options/option_table.h"

namespace defray::cli {

/// What --camera is for the image's own metadata; no file is called so.
inline const std::string from_metadata = "from-metadata";

using CameraField = std::optional<double> CameraValues::*;

/// Where a number of all frames goes, and one of a frame.
struct LensNumber {
  std::function<void(double)> of_all;
  std::function<void(FrameLens&, double)> of_frame;
};
LensNumber number_of(CameraValues& camera, CameraField field);

/// What was typed for a number of the lens; one that changes over a sequence goes to `animated`.
/// Throws Error(usage) that begins with the option's name.
void set_lens_number(const LensNumber& number, AnimatedLens* animated, const OptionText& option,
                     const std::string& text);

/// An option of such a number. Null: it may not change.
OptionValue lens_value(LensNumber number, AnimatedLens* animated, std::string default_text = "");
OptionValue lens_value(CameraValues& camera, CameraField field, AnimatedLens* animated,
                       std::string default_text = "");

/// Focus, aperture, focal length, sensor; `unit` is that of the focus distance.
std::vector<OptionRow> lens_rows(CameraValues& camera, const std::string& unit,
                                 AnimatedLens* animated = nullptr);

/// What the picture spans, other than by --sensor-width.
std::vector<OptionRow> sensor_rows(CameraValues& camera, AnimatedLens* animated);

/// --scale and --perceived-distance.
std::vector<OptionRow> scale_rows(CameraValues& camera, AnimatedLens& animated);

/// --eye and its display.
std::vector<OptionRow> eye_rows(EyeOptions& eye, AnimatedLens& animated);

/// What the eye says; nothing without one. Throws Error(usage).
CameraValues eye_of(const EyeOptions& eye);

/// A note where its pixels per metre are all that `stated`, which wins, leaves of the eye. Else
/// empty.
std::string note_on_eye(const EyeOptions& eye, const CameraValues& stated);

/// --max-coc.
OptionRow max_coc_row(double& max_coc_px, AnimatedLens& animated);

/// Whether these say everything that a lens's optics have.
bool has_optics(const Given& given);

/// False where options win over everything that a camera can say.
bool is_camera_heard(const Given& given);

/// --camera and --focus-setting. `others` says what else --camera can be than a file.
std::vector<OptionRow> camera_rows(std::string& file, std::string& focus_setting,
                                   const std::string& others);

}  // namespace defray::cli
