#include "viewer_window/programs.h"

#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>
#include <fmt/format.h>

#include <numbers>

namespace brickfall::viewer {
namespace {

std::string headOf(const ProgramUse& use) {
  std::string head = "#version 330 core\n";
  if (use.depthShadows) head += "#define DEPTH_SHADOWS\n";
  const appearance::Rgb shade = stencilShade().light;
  head += fmt::format("const vec3 kStencilLight = vec3({:.4f}, {:.4f}, {:.4f});\n", shade.x, shade.y, shade.z);
  return head;
}

Ogre::HighLevelGpuProgramPtr makeProgram(const std::string& name, Ogre::GpuProgramType type, const std::string& text) {
  auto& programs = Ogre::HighLevelGpuProgramManager::getSingleton();
  auto program = programs.createProgram(name, Ogre::RGN_DEFAULT, "glsl", type);
  program->setSource(text);
  program->load();
  return program;
}

// A program names of these what it needs.
void bindNames(Ogre::GpuProgramParameters& parameters) {
  using Auto = Ogre::GpuProgramParameters;
  parameters.setIgnoreMissingParams(true);
  parameters.setNamedAutoConstant("viewProjection", Auto::ACT_VIEWPROJ_MATRIX);
  parameters.setNamedAutoConstant("inverseViewProjection", Auto::ACT_INVERSE_VIEWPROJ_MATRIX);
  parameters.setNamedAutoConstant("projection", Auto::ACT_WORLDVIEWPROJ_MATRIX);
  parameters.setNamedAutoConstant("shadowMatrix", Auto::ACT_TEXTURE_VIEWPROJ_MATRIX, 0);
  parameters.setNamedAutoConstant("eye", Auto::ACT_CAMERA_POSITION);
  parameters.setNamedAutoConstant("viewHeight", Auto::ACT_VIEWPORT_HEIGHT);
  parameters.setNamedConstant("flatColour", Ogre::Real(0));
}

}  // namespace

Ogre::MaterialPtr makeMaterial(const ProgramUse& use) {
  const std::string head = headOf(use);
  std::string fragment = head;
  for (const std::string& name : use.common) fragment += std::string(shaderText(name)) + "\n";
  fragment += shaderText(use.fragment);
  makeProgram(use.material + ".vert", Ogre::GPT_VERTEX_PROGRAM, head + std::string(shaderText(use.vertex)));
  makeProgram(use.material + ".frag", Ogre::GPT_FRAGMENT_PROGRAM, fragment);

  const auto material = Ogre::MaterialManager::getSingleton().create(use.material, Ogre::RGN_DEFAULT);
  Ogre::Pass& pass = passOf(material);
  pass.setLightingEnabled(false);
  pass.setVertexProgram(use.material + ".vert");
  pass.setFragmentProgram(use.material + ".frag");
  bindNames(*pass.getVertexProgramParameters());
  bindNames(*pass.getFragmentProgramParameters());
  return material;
}

Ogre::Pass& passOf(const Ogre::MaterialPtr& material) { return *material->getTechnique(0)->getPass(0); }

void setSunOf(Ogre::GpuProgramParameters& parameters, Vec3 towardsSun) {
  parameters.setIgnoreMissingParams(true);
  parameters.setNamedConstant(
      "sun", Ogre::Vector3(Ogre::Real(towardsSun.x), Ogre::Real(towardsSun.y), Ogre::Real(towardsSun.z)));
}

StencilShade stencilShade() {
  using appearance::Rgb, appearance::Vec3f;
  const Vec3f sun = appearance::sunOver({0, 0, 1}), normal = normalized(Vec3f{0, 1, 1});
  const Rgb ambient = appearance::ambientLight(normal, sun);
  const Rgb lit = ambient + appearance::sunLight() * (dot(normal, sun) / std::numbers::pi_v<float>);
  StencilShade out;
  constexpr float kColour = 0.3f;
  const Rgb dark = appearance::shownAs(ambient * kColour), bright = appearance::shownAs(lit * kColour);
  for (int k = 0; k < 3; k++) {
    out.light[k] = ambient[k] / lit[k];
    out.pixel[k] = appearance::srgbFromLinear(dark[k]) / appearance::srgbFromLinear(bright[k]);
  }
  return out;
}

}  // namespace brickfall::viewer
