#pragma once
// Where tuning is kept: a JSON file a device, in the results schema of the auto-tuning community
// ("T4": Kernel Tuner and KTT read it), in the user's cache folder.
#include <string>
#include <vector>

#include "tuning/device_file.h"
#include "tuning/results.h"

namespace defray::tuning {

/// Of the device's results; empty where there is no cache folder.
std::string path_of(const Key& key);

struct Tuning {
  std::vector<Result> results;
  std::string notice;  ///< Why a file that is there was not used, and what to do; else empty.
};

/// What the file knows; nothing, and no notice, without one. `most_items`: work-groups of more
/// are none of this device.
Tuning read(const std::string& path, const Key& key, std::size_t most_items);

/// Merges with what the file knows meanwhile (another tuner may be at work) and writes it anew,
/// whole or not at all. What the file held of other drivers or kernels goes. All that is known
/// then. Throws Error(output).
std::vector<Result> add(const std::string& path, const Key& key, std::size_t most_items,
                        const std::vector<Result>& results);

/// The file's text.
std::string to_text(const Key& key, const std::vector<Result>& results);

}  // namespace defray::tuning
