// ImGui: its start, fonts and colours, and what SDL says for it. Ogre's overlay library draws it.
#pragma once
#include <OgrePrerequisites.h>

#include <cstdint>
#include <memory>

#include "viewer_window/native_window.h"

union SDL_Event;

namespace brickfall::viewer {

class Gui {
 public:
  Gui(Ogre::Viewport& port, WindowSize size);
  ~Gui();
  void resize(WindowSize size);
  // ImGui of this version looks at mouse and keys once a picture, so that down and up within one would be lost. Such an event waits
  // for the next picture, with all that came after it.
  bool mustWait(const SDL_Event& event) const;
  // What ImGui needs of it.
  void take(const SDL_Event& event);
  void releaseButtons(std::uint32_t held);  // those that are not in SDL's mask of held ones
  void setMouseAside();                     // the scene has the mouse
  // A text field will have the cursor soon: what is typed waits for it.
  void awaitText() { awaitedPictures_ = kAwaitedPictures; }
  bool wantsMouse() const;  // something of the panel is held, or a list is open
  bool wantsKeys() const;   // a text is being typed, or will be
  // Between these the panel is laid out; the picture that follows shows it.
  void begin(double seconds);
  void end();
  void setVisible(bool visible);  // of everything; for pictures of the scene alone

 private:
  class Overlay;
  static constexpr int kAwaitedPictures = 6;  // a field has it after two
  std::unique_ptr<Overlay> overlay_;
  // Since the last picture.
  bool buttonChanged_ = false, keyChanged_ = false;
  int awaitedPictures_ = 0;
};

}  // namespace brickfall::viewer
