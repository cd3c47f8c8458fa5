#pragma once
// A built-in scene before its lens, as methods take it: for experiments.
#include <string>
#include <vector>

#include "methods/method.h"
#include "scenes/scene.h"
#include "scenes/tracing/render.h"

namespace defray {

/// A scene in focus, ready for every method.
struct Subject {
  Scene scene;
  Lens lens;
  ScenePicture pinhole;  ///< Depth as methods take it: +inf where nothing is hit.
  Quanta coc;

  Frame frame() const { return {scene.width, scene.height, coc, pinhole.depth, pinhole.colour}; }
};

/// Throws Error(usage) where the scene has no such focus setting.
Subject make_subject(Backend& backend, Scene scene, const std::string& setting);

/// The CoC kernel and the method, as `defray render` runs them.
std::vector<Plane> render(Backend& backend, const Subject& subject, const MethodSettings& settings);

}  // namespace defray
