// defray psf: the geometric PSF that defray renders with, against the diffraction PSF.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "commands.h"
#include "image/ldr.h"
#include "image/safe_output.h"
#include "lens/camera.h"
#include "measure/psf_report.h"
#include "options/camera_file.h"
#include "options/lens_rows.h"
#include "progress.h"

namespace defray::cli {
namespace {

struct PsfOptions {
  double depth = 0;
  CameraValues camera;
  std::string camera_file, focus_setting;
  int width = 1920;
  std::vector<double> wavelengths_nm{450, 550, 650};
  std::string output, csv;
  bool log = false, json = false;
};

void check_outputs(const PsfOptions& o) {
  if (!o.output.empty()) {
    if (!is_ldr_path(o.output)) fail(ErrorKind::usage, "{}: a chart is PNG or JPEG", o.output);
    check_can_write(o.output);
  }
  if (!o.csv.empty()) check_can_write(o.csv);
  std::error_code ignored;
  if (std::filesystem::equivalent(o.csv, o.camera_file, ignored)) {
    fail(ErrorKind::usage, "{}: is input and output at once; write to another file", o.csv);
  }
  if (is_same_file(o.csv, o.output)) {
    fail(ErrorKind::usage, "{}: -o and --csv are the same file", o.csv);
  }
}

Lens lens_of(const PsfOptions& o) {
  CameraValues values = o.camera;
  if (!o.camera_file.empty()) {
    values = read_camera_file(o.camera_file, o.focus_setting, 1).overridden_by(values);
  }
  return make_lens(values, 1, LensModel::breathing, 0);
}

void print_json(const PsfReport& r) {
  nlohmann::ordered_json wavelengths = nlohmann::ordered_json::array();
  for (const PsfCurve& c : r.monochrome) {
    wavelengths.push_back({{"wavelength_nm", c.wavelength_nm},
                           {"airy_diameter_um", c.airy_diameter_um},
                           {"airy_diameter_px", c.airy_diameter_px},
                           {"energy_outside", c.energy_outside}});
  }
  const nlohmann::ordered_json line = {{"coc_diameter_px", r.coc_diameter_px},
                                       {"pixel_um", r.pixel_um},
                                       {"fresnel_zones", r.fresnel_zones},
                                       {"diffraction_matters", r.diffraction_matters},
                                       {"wavelengths", wavelengths}};
  fmt::print("{}\n", line.dump());
}

void print_text(const PsfReport& r) {
  fmt::print("geometric CoC diameter {:.4g} px, pixel {:.4g} um, {:.4g} Fresnel zones\n",
             r.coc_diameter_px, r.pixel_um, r.fresnel_zones);
  for (const PsfCurve& c : r.monochrome) {
    fmt::print("{:g} nm: Airy diameter {:.4g} um = {:.4g} px, {:.2f} % of the energy outside\n",
               c.wavelength_nm, c.airy_diameter_um, c.airy_diameter_px, 100 * c.energy_outside);
  }
  fmt::print(
      "diffraction {} here (it does where the Airy diameter exceeds both a pixel and the CoC "
      "diameter, or over 10 % of the energy is outside: beyond the CoC radius + 1 px)\n",
      r.diffraction_matters ? "matters" : "does not matter");
}

int run(const PsfOptions& o) {
  const Lens lens = lens_of(o);
  check_outputs(o);
  const PsfReport report = [&] {
    ProgressBar bar(1, "PSF", true);
    return measure_psf(lens, o.depth, o.width, o.wavelengths_nm,
                       [&](double share) { bar.update(0, share); });
  }();
  if (!o.output.empty()) write_plot(o.output, psf_plot(report, o.log));
  if (!o.csv.empty()) write_psf_csv(o.csv, report);
  if (o.json) {
    print_json(report);
  } else {
    print_text(report);
  }
  return 0;
}

std::vector<OptionGroup> psf_options(PsfOptions& o) {
  const Needs chart{[](const Given& given) { return given("--output"); }, "requires --output"};
  OptionGroup lens{"Lens", lens_rows(o.camera, "m")};
  for (OptionRow& row : camera_rows(o.camera_file, o.focus_setting, "")) {
    lens.rows.push_back(std::move(row));
  }
  return {{"",
           {{"--depth",
             with_default(value(o.depth), ""),
             "Planar depth of the point, m; inf is allowed",
             {.is_required = true}}}},
          lens,
          {"What is computed",
           {{"--width", value(o.width), "Pixels across the sensor"},
            {"--wavelength", values(o.wavelengths_nm),
             "Wavelengths in nm, 100 to 20000, comma-separated"}}},
          {"Output",
           {{"-o,--output", value(o.output), "Chart of both PSFs, PNG or JPEG"},
            {"--log", flag(o.log), "The chart's densities on a logarithmic axis", {.needs = chart}},
            {"--csv", value(o.csv), "Table of both PSFs, energy per square pixel"},
            {"--json", flag(o.json), "Print one JSON object"}}}};
}

}  // namespace

Run add_psf(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "psf", "Compare the geometric PSF, which render uses, with the diffraction PSF");
  auto o = std::make_shared<PsfOptions>();
  const OptionTable options(*command, psf_options(*o));
  command->footer(
      "Diffraction: Fresnel integral over the circular aperture (Shinya 1994, eq. 4), each\n"
      "wavelength alone and the mean over the band they span. It matters where the Airy diameter\n"
      "exceeds both a pixel and the CoC diameter, or more than 10 % of the energy lies more than "
      "a\n"
      "pixel outside the geometric disc. The lens is the breathing one of 'defray render'.\n"
      "Example: defray psf --depth 4 --focus 3 --fstop 2.8 --focal-length 50 -o psf.png");
  return [o, options] {
    options.set();
    options.refuse_idle();
    return run(*o);
  };
}

}  // namespace defray::cli
