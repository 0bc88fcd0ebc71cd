// The window as SDL makes it. Nothing of Ogre: whether there is a display at all is known before Ogre is touched, which would
// crash without one.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "brickfall/result.h"

struct SDL_Window;

namespace brickfall::viewer {

struct WindowSize {
  int width = 1280, height = 720;  // pixels
};

class NativeWindow {
 public:
  // The error is one line for the user: no display, or what SDL could not do.
  static Result<NativeWindow> open(const std::string& title, WindowSize size);
  NativeWindow(NativeWindow&&) noexcept = default;

  // Whether a graphics card draws, or the processor has to: then what a card does for nothing is better left out. Asked of
  // OpenGL, in a window that is not seen.
  static bool hasGraphicsCard();

  SDL_Window* get() const { return window_.get(); }
  std::uint64_t handle() const;  // of the X window, as Ogre takes it
  WindowSize size() const;
  void setTitle(const std::string& title);
  bool fullScreen() const;
  void setFullScreen(bool on);

 private:
  // The video system outlives the window.
  struct Video {
    ~Video();
  };
  struct Close {
    void operator()(SDL_Window* window) const;
  };
  NativeWindow() = default;
  std::unique_ptr<Video> video_;
  std::unique_ptr<SDL_Window, Close> window_;
};

}  // namespace brickfall::viewer
