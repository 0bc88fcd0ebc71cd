#include "viewer_window/looks.h"

#include <OgreGpuProgramParams.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "appearance/bake.h"
#include "appearance/draw_mesh.h"
#include "appearance/noise.h"
#include "viewer_window/depth_shadows.h"
#include "viewer_window/programs.h"
#include "viewer_window/strips.h"

namespace brickfall::viewer {
namespace {

constexpr double kPlaneReach = 400;  // m: a fixed plane is drawn this far; haze hides its end
constexpr float kTile = 0.5f;        // m: side of all other textures
constexpr std::uint32_t kMortarColour = 0xA9A69F;
constexpr int kPatterns = 4;  // of each surface, so that neighbours differ

struct LayerSize {
  unsigned width = 0, height = 0, layers = 0;
};

// Four bytes a texel, layer after layer.
Ogre::TexturePtr upload(const std::string& name, LayerSize size, const std::vector<std::uint8_t>& pixels) {
  auto texture = Ogre::TextureManager::getSingleton().createManual(
      name, Ogre::RGN_DEFAULT, Ogre::TEX_TYPE_2D_ARRAY, size.width, size.height, size.layers, Ogre::MIP_UNLIMITED,
      Ogre::PF_BYTE_RGBA, Ogre::TU_DEFAULT | Ogre::TU_AUTOMIPMAP);
  const Ogre::PixelBox all(size.width, size.height, size.layers, Ogre::PF_BYTE_RGBA,
                           const_cast<std::uint8_t*>(pixels.data()));
  texture->getBuffer()->blitFromMemory(all);
  return texture;
}

// Of what is baked. Bodies differ from it, but for the ground, whose colour may be another than its material's.
appearance::Rgb usualColour(const SurfaceKey& surface) {
  if (surface.role != BodyRole::ground) return appearance::linearFromHex(surface.colour);
  return appearance::lookOf({surface.material, surface.role, surface.colour, 0}).colour;
}

int patternsOf(const SurfaceKey& surface) {
  return appearance::lookOf({surface.material, surface.role, surface.colour, 0}).relief > 0 ? kPatterns : 1;
}

struct Layers {
  LayerSize size;
  std::vector<std::uint8_t> colour, normal;
};

// The dearest part of opening a scene: one half of the layers on another thread.
Layers bakeLayers(const SurfaceKey& surface) {
  const int faces = surface.faces ? 3 : 1, patterns = patternsOf(surface);
  const unsigned width = patterns > 1 ? 128 : 16;  // without relief nothing fine is to be seen
  Layers out{{width, surface.faces ? width / 2 : width, unsigned(patterns * faces)}, {}, {}};
  std::vector<appearance::BakedImages> images(std::size_t(patterns * faces));
  const auto bakeEach = [&](std::size_t first) {
    for (std::size_t i = first; i < images.size(); i += 2) {
      appearance::Look look =
          appearance::lookOf({surface.material, surface.role, surface.colour, std::uint32_t(i / std::size_t(faces))});
      look.colour = usualColour(surface);
      const appearance::Vec3f half{kBrickHalf[0], kBrickHalf[1], kBrickHalf[2]};
      const auto area = surface.faces ? appearance::boxFace(half, int(i) % 3) : appearance::groundPatch(kTile);
      images[i] = appearance::bake(look, area, int(out.size.width), int(out.size.height));
    }
  };
  std::thread other([&] { bakeEach(1); });
  bakeEach(0);
  other.join();
  for (const appearance::BakedImages& image : images) {
    out.colour.insert(out.colour.end(), image.colour.begin(), image.colour.end());
    out.normal.insert(out.normal.end(), image.normal.begin(), image.normal.end());
  }
  return out;
}

}  // namespace

bool isScaled(const ShapeDef& shape) { return shape.type == ShapeType::sphere; }

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
    case ShapeType::cylinder:
      std::snprintf(text, sizeof text, "cylinder %.4f %.4f", shape.radius, shape.halfHeight);
      return text;
    case ShapeType::cone:
      std::snprintf(text, sizeof text, "cone %.4f %.4f %.4f", shape.radius, shape.topRadius, shape.halfHeight);
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

PartLook partLook(const ListedBody& body, std::size_t part) {
  PartLook look{body.material, body.role, body.colour, body.number};
  if (part >= body.drawnMaterials.size() || body.drawnMaterials[part] == body.material) return look;
  look.material = body.drawnMaterials[part];
  // In old takes a body has one colour, that of its first material; its mortar has its own.
  if (part < body.drawnColours.size())
    look.colour = body.drawnColours[part];
  else if (look.material == "mortar")
    look.colour = kMortarColour;
  return look;
}

SurfaceKey surfaceOf(const PartLook& body, const ShapeDef& shape) {
  SurfaceKey key;
  key.material = body.material;
  key.role = body.role;
  key.colour = body.colour;
  key.plane = shape.type == ShapeType::plane;
  key.faces = appearance::kindOf(body.material, body.role) == appearance::Kind::brick && shape.type == ShapeType::box;
  return key;
}

DrawMesh drawMeshOf(const ShapeDef& shape, const SurfaceKey& surface) {
  ShapeMesh mesh;
  if (shape.type == ShapeType::plane) {
    mesh = planeMesh(kPlaneReach);
  } else if (shape.type == ShapeType::sphere) {
    mesh = sphereMesh(1, {16, 32});
  } else if (Result<ShapeMesh> made = appearance::makeDrawMesh(shape); made) {
    mesh = std::move(made).value();
  }
  DrawMesh out{std::move(mesh.positions), std::move(mesh.normals), {}, std::move(mesh.indices)};
  const bool round = shape.type == ShapeType::sphere || shape.type == ShapeType::capsule;
  for (std::size_t i = 0; i < mesh.uvs.size(); i++) {
    const auto [u, v] = mesh.uvs[i];
    if (surface.faces) {
      const auto& normal = out.normals[i];
      int axis = 0;
      for (int k = 1; k < 3; k++) axis = std::fabs(normal[k]) > std::fabs(normal[axis]) ? k : axis;
      out.uvs.push_back({u / (2 * kBrickHalf[(axis + 1) % 3]), v / (2 * kBrickHalf[(axis + 2) % 3]), float(axis)});
    } else if (round) {
      out.uvs.push_back({4 * u, 2 * v, 0});  // whole numbers: the pattern closes around it
    } else {
      const float scale = surface.plane ? 1 : 1 / kTile;
      out.uvs.push_back({u * scale, v * scale, 0});
    }
  }
  if (surface.faces) giveStripsOneFace(out, shape.halfExtents);
  return out;
}

Instance instanceOf(const PartLook& body, const SurfaceKey& surface) {
  const appearance::Look look = appearance::lookOf({body.material, body.role, body.colour, body.number});
  Instance out;
  const appearance::Rgb usual = usualColour(surface);
  for (int k = 0; k < 3; k++) {
    out.colour[k] = look.colour[k] / std::max(usual[k], 1e-3f);
    out.tint[k] = appearance::srgbFromLinear(appearance::clampUnit(look.colour[k]));
  }
  if (surface.plane) return out;  // its texture stays where it is
  const auto pattern = int(appearance::chance(body.number, 101) * float(patternsOf(surface)));
  out.layer = float(pattern * (surface.faces ? 3 : 1));
  // Bricks are seen whole, with their worn edges; what is cut from a larger pattern may lie anywhere in it.
  if (!surface.faces) out.texturePlace = {appearance::chance(body.number, 102), appearance::chance(body.number, 103)};
  return out;
}

Looks::Looks(bool fine) : fine_(fine) {
  caster_ = makeMaterial({"caster", "caster.vert", "caster.frag", {}});
  passOf(caster_).setDepthBias(1, 2);
}

const Looks::Textures& Looks::texturesOf(const SurfaceKey& surface) {
  Textures& textures = textures_[surface];
  if (textures.look) return textures;
  const Layers layers = bakeLayers(surface);
  const std::string name = std::to_string(textures_.size());
  textures.look = upload("look" + name, layers.size, layers.colour);
  textures.relief = upload("relief" + name, layers.size, layers.normal);
  return textures;
}

Ogre::MaterialPtr Looks::material(const SurfaceKey& surface, ShadowMode shadows) {
  Ogre::MaterialPtr& made = made_[{surface, shadows}];
  if (!made) made = makeSurface(surface, shadows);
  return made;
}

Ogre::MaterialPtr Looks::makeSurface(const SurfaceKey& surface, ShadowMode shadows) {
  const bool depth = shadows == ShadowMode::depth;
  ProgramUse use;
  use.material = "surface" + std::to_string(made_.size());
  use.vertex = "body.vert";
  use.fragment = surface.plane ? "ground.frag" : "body.frag";
  use.common = {"light.glsl", "lighting.glsl"};
  if (depth) use.common.push_back("shadow.glsl");
  use.depthShadows = depth;
  const auto material = makeMaterial(use);
  material->getTechnique(0)->setShadowCasterMaterial(caster_);
  Ogre::Pass& pass = passOf(material);
  pass.getVertexProgramParameters()->setNamedConstant("faces", Ogre::Real(surface.faces ? 1 : 0));
  pass.getVertexProgramParameters()->setNamedConstant("volumes", Ogre::Real(shadows == ShadowMode::stencil ? 1 : 0));
  const auto parameters = pass.getFragmentProgramParameters();
  parameters->setNamedConstant("bricks", Ogre::Real(surface.faces ? 1 : 0));
  parameters->setNamedConstant("flatColour", Ogre::Real(flat_ ? 1 : 0));
  setSunOf(*parameters, sun_);
  int unit = 0;
  {
    const appearance::Look look = appearance::lookOf({surface.material, surface.role, surface.colour, 0});
    const appearance::Rgb usual = usualColour(surface);
    parameters->setNamedConstant("usual", Ogre::Vector3(usual.x, usual.y, usual.z));
    parameters->setNamedConstant("surface", Ogre::Vector2(look.metalness, look.relief > 0 ? 1.0f : 0.0f));
    const Textures& textures = texturesOf(surface);
    for (const auto& [name, texture] : {std::pair{"look", textures.look}, {"relief", textures.relief}}) {
      parameters->setNamedConstant(name, unit++);
      Ogre::TextureUnitState& state = *pass.createTextureUnitState();
      state.setTexture(texture);
      state.setTextureAddressingMode(Ogre::TextureUnitState::TAM_MIRROR);
      state.setTextureFiltering(fine_ ? Ogre::TFO_ANISOTROPIC : Ogre::TFO_BILINEAR);
      state.setTextureAnisotropy(fine_ ? 8 : 1);
    }
  }
  if (depth) {
    parameters->setNamedConstant("shadowMap", unit);
    parameters->setNamedConstant("shadowTexel", Ogre::Real(1.0 / DepthShadows::kMapSize));
    Ogre::TextureUnitState& map = *pass.createTextureUnitState();
    map.setContentType(Ogre::TextureUnitState::CONTENT_SHADOW);
    map.setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
    map.setTextureFiltering(Ogre::FO_LINEAR, Ogre::FO_LINEAR, Ogre::FO_NONE);
    map.setTextureCompareEnabled(true);
    map.setTextureCompareFunction(Ogre::CMPF_LESS_EQUAL);
  }
  return material;
}

void Looks::setFlat(bool flat) {
  flat_ = flat;
  for (auto& [key, material] : made_) {
    passOf(material).getFragmentProgramParameters()->setNamedConstant("flatColour", Ogre::Real(flat ? 1 : 0));
  }
}

void Looks::setSun(Vec3 towardsSun) {
  sun_ = towardsSun;
  for (auto& [key, material] : made_) setSunOf(*passOf(material).getFragmentProgramParameters(), sun_);
}

}  // namespace brickfall::viewer
