// Reading a file, and what is refused before anything is allocated for it.
#include <filesystem>

#include "base/error.h"
#include "base/input_file.h"
#include "base/memory.h"
#include "base/window.h"
#include "image/file_format.h"
#include "image/image_file_part.h"
#include "image/sequence.h"

namespace defray {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

constexpr int max_channels = 4096;

/// Sizes come from the header, before anything is allocated: OpenImageIO does not limit EXR.
void check_size(const std::string& path, const ImageSpec& spec, std::uint64_t bytes_before) {
  if (!has_allowed_size(spec.width, spec.height) || spec.depth > 1) {
    fail(ErrorKind::input,
         "{}: header says {}x{}x{} pixels; allowed are 1 to {} a side and {} in all", path,
         spec.width, spec.height, spec.depth, max_side, max_pixels);
  }
  if (spec.nchannels < 1 || spec.nchannels > max_channels) {
    fail(ErrorKind::input, "{}: header says {} channels; allowed are 1 to {}", path, spec.nchannels,
         max_channels);
  }
  if (spec.full_width < 1 || spec.full_height < 1) {
    fail(ErrorKind::input, "{}: display window {}x{} is empty", path, spec.full_width,
         spec.full_height);
  }
  const std::uint64_t bytes = bytes_before + spec.image_bytes(true);
  if (const std::uint64_t memory = usable_memory(); bytes > memory) {
    fail(ErrorKind::input, "{}: its pixels take {} MiB; there are {} MiB of memory", path,
         bytes >> 20, memory >> 20);
  }
}

/// Of a movie, by its name: FFmpeg ends the process on some that are damaged, once they are opened.
bool is_movie(const std::string& path) {
  const auto reader = ImageInput::create(path);
  if (!reader) OIIO::geterror();  // open() has its own
  return reader && reader->format_name() == std::string("FFmpeg movie");
}

/// What a name of no file was meant to be.
std::string about_missing(const std::string& path) {
  if (path == "-") return "; standard input can be the picture that is rendered, nothing else";
  if (path.find_first_of("*?") != std::string::npos) {
    return "; #### stands for the numbers of a sequence";
  }
  return has_frame_pattern(path) ? "; here goes one picture, not a sequence" : "";
}

}  // namespace

ImageFile ImageFile::read(const std::string& path, Content content) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown) && !unknown) {
    fail(ErrorKind::input, "{}: no such file{}", path, about_missing(path));
  }
  check_readable(path);
  check_format_is_as_named(path);
  if (!is_ldr_path(path)) return read_linear_file(path);
  const LdrPicture picture = read_ldr(path, content);
  require_allowed_size(path + ":", picture.width, picture.height);
  const bool is_exact = content == Content::picture && picture.bits == 8;  // in half floats
  const Sample sample = is_exact ? Sample::half_float : Sample::single_float;
  ImageFile file =
      from_planes(picture.channels, picture.planes, picture.width, picture.height, sample);
  file.path_ = path;
  file.encoded_bits_ = picture.bits;
  file.refresh_info();
  return file;
}

ImageFile ImageFile::read_linear_file(const std::string& path) {
  ImageFile file;
  file.path_ = path;
  if (is_movie(path)) {
    fail(ErrorKind::input, "{}: is a movie; allowed are pictures, a file a frame", path);
  }
  // Damaged headers make the library throw now and then; all of it is one kind of bad input.
  try {
    const auto input = ImageInput::open(path);
    if (!input) {
      fail(ErrorKind::input, "{}: not a readable image: {}", path, first_line(OIIO::geterror()));
    }
    std::uint64_t bytes = 0;
    for (int s = 0; s == 0 || input->seek_subimage(s, 0); ++s) {  // it is open at the first
      const ImageSpec spec = input->spec();
      check_size(path, spec, bytes);
      bytes += spec.image_bytes(true);
      if (spec.deep) {
        fail(ErrorKind::input, "{}: is a deep image; flatten it first (oiiotool --flatten)", path);
      }
      Part part{spec, std::vector<std::byte>(spec.image_bytes(true))};
      if (!input->read_image(s, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, part.pixels.data())) {
        fail(ErrorKind::input, "{}: cannot read its pixels: {}", path,
             first_line(input->geterror()));
      }
      file.parts_.push_back(std::move(part));
    }
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail(ErrorKind::input, "{}: not enough memory to read it", path);
  } catch (const std::exception& error) {
    fail(ErrorKind::input, "{}: not a readable image: {}", path, first_line(error.what()));
  }
  file.refresh_info();
  return file;
}

}  // namespace defray
