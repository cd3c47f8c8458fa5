#include "image/output.h"

#include <filesystem>

#include "error.h"
#include "image/ldr.h"
#include "image/safe_output.h"
#include "params.h"
#include "text.h"

namespace defray {
namespace {

std::string extension(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

bool is_exr(const std::string& path) { return extension(path) == ".exr"; }

void write_display_encoded(const std::string& path, const Window& data,
                           const std::vector<Plane>& colour, std::vector<std::string>& notes) {
  notes.push_back("values outside 0...1 are clipped by the 8-bit output");
  const LdrPicture picture{data.width, data.height, {}, colour};
  write_safely(path, [&](const std::string& name) { write_ldr(name, picture); });
}

}  // namespace

void check_output_format(const std::string& path) {
  const std::vector<std::string> allowed{".exr", ".tif", ".tiff", ".hdr", ".png", ".jpg", ".jpeg"};
  const std::string e = extension(path);
  for (const std::string& a : allowed) {
    if (e == a) return;
  }
  fail(ExitCode::usage, "{}: cannot write format '{}'; allowed are {}", path, e,
       join(allowed, " "));
}

void write_picture(const std::string& path, ImageFile& file, const ColourChoice& choice,
                   const std::vector<Plane>& colour, std::vector<std::string>& notes) {
  const PartInfo& part = file.parts()[static_cast<std::size_t>(choice.part)];
  if (is_ldr_path(path)) return write_display_encoded(path, part.data, colour, notes);
  for (std::size_t c = 0; c < colour.size(); ++c) {
    file.set_plane(choice.part, choice.channels[c], colour[c]);
  }
  const bool same_format = extension(path) == extension(file.path());
  const bool keeps_all = same_format || (is_exr(path) && is_ldr_path(file.path()));
  write_safely(path, [&](const std::string& name) {
    if (keeps_all) return file.write(name);
    std::vector<int> channels = choice.channels;
    if (extension(path) == ".hdr") channels.resize(3);
    notes.push_back("only colour is written: other channels stay behind in a change of format");
    file.extract(choice.part, channels).write(name);
  });
}

void write_coc(const std::string& path, const ImageFile& like, int part,
               const std::vector<std::int32_t>& coc_quanta) {
  if (!is_exr(path) && extension(path) != ".tif" && extension(path) != ".tiff") {
    fail(ExitCode::usage, "{}: a CoC has signs and sizes; --coc-out takes .exr or .tif", path);
  }
  Plane radii(coc_quanta.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    radii[i] = static_cast<float>(coc_quanta[i]) / (1 << DEFRAY_COC_FRACTION_BITS);
  }
  ImageFile file = like.extract(part, {0});
  file.rename_channel(0, 0, "coc");
  file.set_plane(0, 0, radii);
  write_safely(path, [&](const std::string& name) { file.write(name); });
}

}  // namespace defray
