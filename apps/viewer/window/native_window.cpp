#include "viewer_window/native_window.h"

#include <SDL.h>
#include <SDL_syswm.h>

namespace brickfall::viewer {

NativeWindow::Video::~Video() { SDL_Quit(); }

void NativeWindow::Close::operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }

Result<NativeWindow> NativeWindow::open(const std::string& title, WindowSize size) {
  // Ogre draws by GLX, which needs an X window; Wayland desktops bring one.
  SDL_SetHint(SDL_HINT_VIDEODRIVER, "x11");
  SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
  SDL_SetHint(SDL_HINT_MOUSE_FOCUS_CLICKTHROUGH, "1");
  // Ctrl-C ends the viewer as any other program, and a window that merely lost the focus stays where it is.
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_VIDEO_MINIMIZE_ON_FOCUS_LOSS, "0");
  if (SDL_Init(SDL_INIT_VIDEO) != 0) {
    const char* display = SDL_getenv("DISPLAY");
    return Error{ErrorCode::wrongState,
                 std::string("no display: ") +
                     (display && *display ? "the X server at DISPLAY=" + std::string(display) + " does not answer"
                                          : std::string("DISPLAY is not set")) +
                     "; expected a desktop, or run it under xvfb-run (pictures without a window: brickfall render)"};
  }
  NativeWindow made;
  made.video_ = std::make_unique<Video>();
  made.window_.reset(SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, size.width,
                                      size.height, SDL_WINDOW_RESIZABLE));
  if (!made.window_) return Error{ErrorCode::wrongState, std::string("the window cannot be opened: ") + SDL_GetError()};
  SDL_SetWindowMinimumSize(made.get(), 320, 200);
  return made;
}

bool NativeWindow::hasGraphicsCard() {
  SDL_Window* window = SDL_CreateWindow("", 0, 0, 16, 16, SDL_WINDOW_OPENGL | SDL_WINDOW_HIDDEN);
  if (!window) return false;
  std::string name;
  if (SDL_GLContext context = SDL_GL_CreateContext(window)) {
    using GetString = const unsigned char* (*)(unsigned);
    constexpr unsigned kRendererName = 0x1F01;  // GL_RENDERER
    const auto getString = reinterpret_cast<GetString>(SDL_GL_GetProcAddress("glGetString"));
    if (getString && getString(kRendererName)) name = reinterpret_cast<const char*>(getString(kRendererName));
    SDL_GL_DeleteContext(context);
  }
  SDL_DestroyWindow(window);
  const auto names = [&](const char* word) { return name.find(word) != std::string::npos; };
  return !name.empty() && !names("llvmpipe") && !names("softpipe") && !names("swrast") && !names("Software");
}

std::uint64_t NativeWindow::handle() const {
  SDL_SysWMinfo info;
  SDL_VERSION(&info.version);
  if (SDL_GetWindowWMInfo(get(), &info) != SDL_TRUE) return 0;
  return info.info.x11.window;
}

WindowSize NativeWindow::size() const {
  WindowSize size;
  SDL_GetWindowSize(get(), &size.width, &size.height);
  return size;
}

void NativeWindow::setTitle(const std::string& title) { SDL_SetWindowTitle(get(), title.c_str()); }

bool NativeWindow::fullScreen() const { return (SDL_GetWindowFlags(get()) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0; }

void NativeWindow::setFullScreen(bool on) { SDL_SetWindowFullscreen(get(), on ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0); }

}  // namespace brickfall::viewer
