#pragma once
// --show: the picture in a window whose keys and mouse change the lens.
#include <optional>
#include <string>
#include <vector>

#include "defray/defray.h"
#include "image/viewer.h"
#include "render/render_command.h"

namespace defray::cli {

class ShowSession {
 public:
  ShowSession(const RenderCommand& job, std::vector<std::optional<int>> frames, Device& device);

  /// Shows the last frame as it was rendered, until the window is closed. Throws Error.
  void run(const std::vector<Plane>& rendered);

  /// The command that renders what was seen last.
  std::string command() const;

 private:
  /// A frame on the screen, before and after, and its lens.
  struct View {
    std::vector<Plane> before, after;
    Plane coc_px;
    Lens lens;
    double farthest_units = 0;
    Window display;
  };

  bool has_lens() const { return defray::has_lens(job_.settings.method.method); }
  /// True: the window is to be closed.
  bool handle(const ViewerEvent& event);
  void handle_key(int key);
  void change_focus(int steps);
  void change_fstop(int steps);
  void step(int frames);
  void read();
  void find_lens();
  void render();  ///< At preview quality.
  void draw(Viewer& viewer) const;
  RenderSettings settings() const;

  const RenderCommand& job_;
  std::vector<std::optional<int>> frames_;
  Device& device_;
  std::size_t at_ = 0;
  std::optional<PictureFile> file_;  ///< The frame.
  View view_;
  std::optional<double> focus_units_, fstop_;  ///< As changed.
  std::optional<PixelPlace> place_;
  bool shows_before_ = false, shows_coc_ = false, is_actual_size_ = false;
};

}  // namespace defray::cli
