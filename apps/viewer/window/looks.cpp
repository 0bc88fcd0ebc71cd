#include "viewer_window/looks.h"

#include <OgreGpuProgramParams.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>

#include <cstdio>

#include "brickfall/geometry/shape_mesh.h"
#include "viewer_window/depth_shadows.h"
#include "viewer_window/programs.h"

namespace brickfall::viewer {
namespace {

constexpr double kPlaneReach = 400;  // m: a fixed plane is drawn this far; haze hides its end

}  // namespace

bool isScaled(const ShapeDef& shape) { return shape.type == ShapeType::sphere; }

DrawMesh drawMeshOf(const ShapeDef& shape) {
  ShapeMesh mesh;
  if (shape.type == ShapeType::plane) {
    mesh = planeMesh(kPlaneReach);
  } else if (shape.type == ShapeType::sphere) {
    mesh = sphereMesh(1, {16, 32});
  } else {
    Result<ShapeMesh> made = makeShapeMesh(shape);
    if (made) mesh = std::move(made).value();
  }
  return {std::move(mesh.positions), std::move(mesh.normals), std::move(mesh.uvs), std::move(mesh.indices)};
}

std::string meshKey(const ShapeDef& shape) {
  char text[120];
  const Vec3 half = shape.halfExtents;
  switch (shape.type) {
    case ShapeType::plane:
      return "plane";
    case ShapeType::sphere:
      return "sphere";
    case ShapeType::box:
      std::snprintf(text, sizeof text, "box %.4f %.4f %.4f", half.x, half.y, half.z);
      return text;
    case ShapeType::capsule:
      std::snprintf(text, sizeof text, "capsule %.4f %.4f", shape.radius, shape.halfHeight);
      return text;
    case ShapeType::hull: {
      std::string key = "hull";
      for (const Vec3 corner : shape.vertices) {
        std::snprintf(text, sizeof text, " %.4f %.4f %.4f", corner.x, corner.y, corner.z);
        key += text;
      }
      return key;
    }
    case ShapeType::mesh:
      std::snprintf(text, sizeof text, "mesh %p", static_cast<const void*>(shape.mesh.get()));
      return text;
  }
  return {};
}

BodyLook lookOf(const ListedBody& body) {
  BodyLook look;
  look.surface = "plain";
  look.usual.colour = {float(body.colour >> 16 & 255) / 255, float(body.colour >> 8 & 255) / 255,
                       float(body.colour & 255) / 255};
  return look;
}

Looks::Looks() { makeCaster(); }

void Looks::makeCaster() {
  caster_ = makeMaterial({"caster", "caster.vert", "caster.frag", {}});
  Ogre::Pass& pass = passOf(caster_);
  pass.setDepthBias(1, 2);
}

Ogre::MaterialPtr Looks::material(const std::string& surface, ShadowMode shadows) {
  const bool depth = shadows == ShadowMode::depth;
  Ogre::MaterialPtr& made = made_[surface + (depth ? "/depth" : "/plain")];
  if (!made) made = makeSurface(surface, depth);
  return made;
}

Ogre::MaterialPtr Looks::makeSurface(const std::string& surface, bool depth) {
  const bool ground = surface == "plane";
  ProgramUse use{surface + (depth ? "/depth" : "/plain"), "body.vert", ground ? "ground.frag" : "body.frag",
                 {"lighting.glsl"}, depth};
  if (depth) use.common.push_back("shadow.glsl");
  const auto material = makeMaterial(use);
  material->getTechnique(0)->setShadowCasterMaterial(caster_);
  Ogre::Pass& pass = passOf(material);
  const auto parameters = pass.getFragmentProgramParameters();
  parameters->setNamedConstant("surface", Ogre::Vector4(0.85f, 0, 0, 1));
  parameters->setNamedConstant("flatColour", Ogre::Real(flat_ ? 1 : 0));
  int unit = 0;
  if (!ground) {
    parameters->setNamedConstant("look", unit++);
    auto texture = Ogre::TextureManager::getSingleton().getByName("white");
    if (!texture) {
      texture = Ogre::TextureManager::getSingleton().createManual("white", Ogre::RGN_DEFAULT, Ogre::TEX_TYPE_2D, 1, 1, 0,
                                                                  Ogre::PF_BYTE_RGBA);
      unsigned char white[4] = {255, 255, 255, 255};
      texture->getBuffer()->blitFromMemory(Ogre::PixelBox(1, 1, 1, Ogre::PF_BYTE_RGBA, white));
    }
    pass.createTextureUnitState()->setTexture(texture);
  }
  if (depth) {
    parameters->setNamedConstant("shadowMap", unit);
    parameters->setNamedConstant("shadowTexel", Ogre::Real(1.0 / DepthShadows::kMapSize));
    Ogre::TextureUnitState* map = pass.createTextureUnitState();
    map->setContentType(Ogre::TextureUnitState::CONTENT_SHADOW);
    map->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
    map->setTextureFiltering(Ogre::FO_LINEAR, Ogre::FO_LINEAR, Ogre::FO_NONE);
    map->setTextureCompareEnabled(true);
    map->setTextureCompareFunction(Ogre::CMPF_LESS_EQUAL);
  }
  return material;
}

void Looks::setFlat(bool flat) {
  flat_ = flat;
  for (auto& [name, material] : made_) {
    passOf(material).getFragmentProgramParameters()->setNamedConstant("flatColour", Ogre::Real(flat ? 1 : 0));
  }
}

}  // namespace brickfall::viewer
