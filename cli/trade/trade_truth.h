#pragma once
// What the lens really gives, beside which pictures are measured.
#include <string>

#include "commands/colour_file.h"
#include "defray/io.h"

namespace defray::cli {

/// The truth's R G B: its only colour, or the input's layer and view of it.
ColourFile read_truth(const std::string& path, const ChannelRequest& request);

/// Throws Error(input) where the truth cannot be compared with pictures of this input.
void check_truth(const std::string& path, const ColourFile& truth, const std::string& input_path,
                 const FrameReport& input);

/// PSNR, sRGB, dB, where both have pixels.
double true_db_of(ColourFile truth, const FrameResult& result);

}  // namespace defray::cli
