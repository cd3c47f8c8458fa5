#include "base/error.h"
#include "defray/io.h"
#include "image/depth_plane.h"
#include "image/output.h"

namespace defray {

struct PictureFile::State {
  ImageFile file;
  ColourChoice choice;
  std::vector<Plane> colour = {};
  Plane depth = {};
  Picture picture = {};
};

PictureFile::PictureFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
PictureFile::PictureFile(PictureFile&&) noexcept = default;
PictureFile& PictureFile::operator=(PictureFile&&) noexcept = default;
PictureFile::~PictureFile() = default;

PictureFile PictureFile::read(const std::string& path, const ChannelRequest& request,
                              const std::string& depth_path) {
  auto state = std::make_unique<State>(State{ImageFile::read(path), {}});
  State& s = *state;
  s.choice = choose_colour(path, s.file.parts(), request);
  const PartInfo& part = s.file.parts()[static_cast<std::size_t>(s.choice.part)];
  for (const int channel : s.choice.channels) {
    s.colour.push_back(s.file.plane(s.choice.part, channel));
  }
  s.depth = read_depth(s.file, s.choice, request, depth_path).values;
  s.picture = {part.data, part.display, {s.colour.begin(), s.colour.end()}, s.depth};
  return PictureFile(std::move(state));
}

const Picture& PictureFile::picture() const { return state_->picture; }

std::vector<std::string> PictureFile::write(const std::string& path,
                                            const std::vector<Plane>& colour) {
  check_output_format(path);
  if (colour.size() != state_->colour.size()) {
    std::vector<std::string> names;
    for (const int channel : state_->choice.channels) {
      names.push_back(state_->file.parts()[size(state_->choice.part)].channels[size(channel)]);
    }
    fail(ErrorKind::usage, "{}: the picture read has {} ({} planes), the colour to write has {}",
         path, fmt::join(names, " "), names.size(), colour.size());
  }
  for (const Plane& plane : colour) {
    if (plane.size() == state_->depth.size()) continue;
    fail(ErrorKind::usage, "{}: a plane to write has {} values, planes of the picture read have {}",
         path, plane.size(), state_->depth.size());
  }
  std::vector<std::string> notes;
  write_picture(path, state_->file, state_->choice, colour, Bits::as_input, notes);
  return notes;
}

void PictureFile::write_plane(const std::string& path, const std::string& name,
                              const Plane& values) const {
  check_plane_format(path, name);
  if (values.size() != state_->depth.size()) {
    fail(ErrorKind::usage, "{}: {} has {} values, planes of the picture read have {}", path, name,
         values.size(), state_->depth.size());
  }
  defray::write_plane(path, name, state_->file, state_->choice.part, values);
}

}  // namespace defray
