#pragma once
// The built-in scenes, one file each.
#include <memory>

#include "scenes/scene.h"

namespace defray {

Scene make_plate1(int width, int height);

}  // namespace defray
