#pragma once
// The built-in scenes, one file each. Their settings are documented where they are made.
#include "scenes/scene.h"

namespace defray {

Scene make_plate1(int width, int height);

/// `complexity` multiplies the number of objects (60) without changing what they look like from
/// afar, for measuring how cost grows with it. Throws Error(usage) unless 1 <= complexity <= 1000.
Scene make_plate2(int width, int height, int complexity);

Scene make_blocks_lake(int width, int height);
Scene make_blocks_forest(int width, int height);
Scene make_fence(int width, int height);
Scene make_spheres(int width, int height);
Scene make_points(int width, int height);
Scene make_impulses(int width, int height);
Scene make_slanted(int width, int height);
Scene make_lines(int width, int height);
Scene make_highlights(int width, int height);
Scene make_cutout(int width, int height);

constexpr int drift_frames = 24;
/// Frames from 1 to drift_frames.
Scene make_drift(int width, int height, int frame);

constexpr int garden_frames = 24;
/// Frames from 1 to garden_frames.
Scene make_garden(int width, int height, int frame);

}  // namespace defray
