// ImGui: its start, fonts and colours, and what SDL says for it. Ogre's overlay library draws it.
#pragma once
#include <OgrePrerequisites.h>

#include <memory>

#include "viewer_window/native_window.h"

union SDL_Event;

namespace brickfall::viewer {

class Gui {
 public:
  Gui(Ogre::Viewport& port, WindowSize size);
  ~Gui();
  void resize(WindowSize size);
  // What ImGui needs of it.
  void take(const SDL_Event& event);
  bool wantsMouse() const;  // something of the panel is held, or a list is open
  bool wantsKeys() const;   // a text is being typed
  // Between these the panel is laid out; the picture that follows shows it.
  void begin(double seconds);
  void end();
  void setVisible(bool visible);  // of everything; for pictures of the scene alone

 private:
  class Overlay;
  std::unique_ptr<Overlay> overlay_;
};

}  // namespace brickfall::viewer
