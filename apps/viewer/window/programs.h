// The graphics card's programs, and Ogre materials made of them. Their text is compiled into the executable
// (shaders/*, embedded by CMake), so that the installed viewer needs no file of its own.
#pragma once
#include <OgrePrerequisites.h>

#include <string>
#include <string_view>
#include <vector>

#include "appearance/light.h"
#include "brickfall/math.h"

namespace brickfall::viewer {

// By file name, "body.vert"; made by CMake. Ends the program with an assert for a name that is not there.
std::string_view shaderText(std::string_view name);

struct ProgramUse {
  std::string material;             // name, once
  std::string vertex, fragment;     // names of shader files
  std::vector<std::string> common;  // of shader files that go before the fragment's own text
  bool depthShadows = false;        // defines DEPTH_SHADOWS
};

// A material of one pass with these two programs, without lighting of Ogre's own. The matrices and places that the programs
// name (viewProjection, eye, sun ...) are kept by Ogre or set here.
Ogre::MaterialPtr makeMaterial(const ProgramUse& use);
Ogre::Pass& passOf(const Ogre::MaterialPtr& material);
// For programs that light; others leave it.
void setSunOf(Ogre::GpuProgramParameters& parameters, Vec3 towardsSun);

// What modulative shadows leave of light, and of the finished pixel: as sky and ground alone light a surface that is turned half up.
struct StencilShade {
  appearance::Rgb light, pixel;
};
StencilShade stencilShade();

}  // namespace brickfall::viewer
