#include "viewer_window/gui.h"

#include <OgreImGuiOverlay.h>
#include <OgreMaterialManager.h>
#include <OgreOverlayManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>
#include <OgreViewport.h>
#include <SDL.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "viewer_window/gui_style.h"
#include "viewer_window/programs.h"

namespace brickfall::viewer {
namespace {

// ImGui's own names for keys that mean something in a text; the letters only with Ctrl.
const std::pair<int, SDL_Scancode> kKeys[] = {{ImGuiKey_Tab, SDL_SCANCODE_TAB},
                                              {ImGuiKey_LeftArrow, SDL_SCANCODE_LEFT},
                                              {ImGuiKey_RightArrow, SDL_SCANCODE_RIGHT},
                                              {ImGuiKey_UpArrow, SDL_SCANCODE_UP},
                                              {ImGuiKey_DownArrow, SDL_SCANCODE_DOWN},
                                              {ImGuiKey_Home, SDL_SCANCODE_HOME},
                                              {ImGuiKey_End, SDL_SCANCODE_END},
                                              {ImGuiKey_Delete, SDL_SCANCODE_DELETE},
                                              {ImGuiKey_Backspace, SDL_SCANCODE_BACKSPACE},
                                              {ImGuiKey_Enter, SDL_SCANCODE_RETURN},
                                              {ImGuiKey_KeyPadEnter, SDL_SCANCODE_KP_ENTER},
                                              {ImGuiKey_Escape, SDL_SCANCODE_ESCAPE},
                                              {ImGuiKey_A, SDL_SCANCODE_A},
                                              {ImGuiKey_C, SDL_SCANCODE_C},
                                              {ImGuiKey_V, SDL_SCANCODE_V},
                                              {ImGuiKey_X, SDL_SCANCODE_X},
                                              {ImGuiKey_Y, SDL_SCANCODE_Y},
                                              {ImGuiKey_Z, SDL_SCANCODE_Z}};

void nameKeys(ImGuiIO& io) {
  for (const auto& [name, code] : kKeys) io.KeyMap[name] = code;
}

bool means(const SDL_Keysym& key) {
  const bool letter = key.scancode >= SDL_SCANCODE_A && key.scancode <= SDL_SCANCODE_Z;
  if (letter && (key.mod & KMOD_CTRL) == 0) return false;
  return std::any_of(std::begin(kKeys), std::end(kKeys),
                     [&](const auto& named) { return named.second == key.scancode; });
}

int buttonOf(const SDL_Event& event) {
  return event.button.button == SDL_BUTTON_LEFT ? 0 : event.button.button == SDL_BUTTON_RIGHT ? 1 : 2;
}

}  // namespace

class Gui::Overlay {
 public:
  Overlay() : overlay_(new Ogre::ImGuiOverlay) {
    Ogre::OverlayManager::getSingleton().addOverlay(overlay_);  // which owns it from now on
    overlay_->setZOrder(300);
  }
  Ogre::ImGuiOverlay& operator*() { return *overlay_; }

 private:
  Ogre::ImGuiOverlay* overlay_;
};

Gui::Gui(Ogre::Viewport& port, WindowSize size) : overlay_(std::make_unique<Overlay>()) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // the layout is ours
  io.LogFilename = nullptr;
  nameKeys(io);
  useStyle();
  port.setOverlaysEnabled(true);
  resize(size);
  (**overlay_).show();
  // Ogre's material has no program: with a renderer that knows nothing else it would not be seen.
  const auto drawn = Ogre::MaterialManager::getSingleton().getByName("ImGui/material", Ogre::RGN_INTERNAL);
  const auto ours = makeMaterial({"gui", "gui.vert", "gui.frag", {}});
  for (auto* pass : drawn->getTechnique(0)->getPasses()) {
    pass->setVertexProgram("gui.vert");
    pass->setFragmentProgram("gui.frag");
    pass->setVertexProgramParameters(passOf(ours).getVertexProgramParameters());
    pass->setFragmentProgramParameters(passOf(ours).getFragmentProgramParameters());
  }
  drawn->setReceiveShadows(false);
  drawn->load();
}

Gui::~Gui() = default;

void Gui::resize(WindowSize size) { ImGui::GetIO().DisplaySize = ImVec2(float(size.width), float(size.height)); }

bool Gui::mustWait(const SDL_Event& event) const {
  switch (event.type) {
    case SDL_MOUSEMOTION:
    case SDL_MOUSEWHEEL:
      return buttonChanged_;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      return buttonChanged_ || keyChanged_;
    case SDL_TEXTINPUT:
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      return buttonChanged_ || keyChanged_ || awaitedPictures_ > 0;
    default:
      return false;
  }
}

void Gui::take(const SDL_Event& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.type) {
    case SDL_MOUSEMOTION:
      io.MousePos = ImVec2(float(event.motion.x), float(event.motion.y));
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP: {
      io.MousePos = ImVec2(float(event.button.x), float(event.button.y));
      if (event.button.button > 3) break;
      io.MouseDown[buttonOf(event)] = event.type == SDL_MOUSEBUTTONDOWN;
      buttonChanged_ = true;
      break;
    }
    case SDL_MOUSEWHEEL:
      io.MouseWheel += float(event.wheel.y);
      break;
    case SDL_TEXTINPUT:
      io.AddInputCharactersUTF8(event.text.text);
      break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      if (event.key.keysym.scancode < int(std::size(io.KeysDown))) {
        io.KeysDown[event.key.keysym.scancode] = event.type == SDL_KEYDOWN;
      }
      if (wantsKeys() && means(event.key.keysym)) keyChanged_ = true;
      io.KeyCtrl = (event.key.keysym.mod & KMOD_CTRL) != 0;
      io.KeyShift = (event.key.keysym.mod & KMOD_SHIFT) != 0;
      break;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_LEAVE) io.MousePos = ImVec2(-1e9f, -1e9f);
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST)
        std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
      break;
    default:
      break;
  }
}

bool Gui::wantsMouse() const {
  return ImGui::IsAnyItemActive() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}
bool Gui::wantsKeys() const { return ImGui::GetIO().WantTextInput || awaitedPictures_ > 0; }

void Gui::releaseButtons(std::uint32_t held) {
  ImGuiIO& io = ImGui::GetIO();
  const std::pair<int, std::uint32_t> kButtons[] = {
      {0, SDL_BUTTON_LMASK}, {1, SDL_BUTTON_RMASK}, {2, SDL_BUTTON_MMASK}};
  for (const auto& [button, mask] : kButtons) {
    if (!io.MouseDown[button] || (held & mask) != 0) continue;
    io.MouseDown[button] = false;
    buttonChanged_ = true;
  }
}

void Gui::setMouseAside() { ImGui::GetIO().MousePos = ImVec2(-1e9f, -1e9f); }

void Gui::begin(double seconds) {
  // Ogre's own NewFrame takes the time from Ogre's clock; what matters is that it is never 0.
  ImGui::GetIO().DeltaTime = float(std::max(seconds, 1e-4));
  ImGui::NewFrame();
  buttonChanged_ = keyChanged_ = false;
  awaitedPictures_ = ImGui::GetIO().WantTextInput ? 0 : std::max(0, awaitedPictures_ - 1);
}

// Ogre calls ImGui::Render while it draws; a window that draws nothing must still end what was begun.
void Gui::end() { ImGui::EndFrame(); }

void Gui::setVisible(bool visible) {
  if (visible) {
    (**overlay_).show();
  } else {
    (**overlay_).hide();
  }
}

}  // namespace brickfall::viewer
