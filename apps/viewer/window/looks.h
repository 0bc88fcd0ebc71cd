// How bodies look, as the window draws them: what apps/appearance says, as meshes and materials of the graphics card.
#pragma once
#include <OgrePrerequisites.h>

#include <map>
#include <string>
#include <vector>

#include "appearance/look.h"
#include "viewer_core/frame.h"
#include "viewer_window/draw_mesh.h"
#include "viewer_window/instance_batch.h"
#include "viewer_window/renderer.h"

namespace brickfall::viewer {

// Spheres share one mesh, of radius 1 m, whatever their size.
bool isScaled(const ShapeDef& shape);
// Equal for shapes with the same mesh.
std::string meshKey(const ShapeDef& shape);

// Textures are baked once for a surface: a material in its usual colour. What differs from body to body is its own colour, one
// of some patterns, and where in the pattern it lies.
struct SurfaceKey {
  std::string material;
  BodyRole role = BodyRole::body;
  std::uint32_t colour = 0;  // 0xRRGGBB
  bool plane = false;        // the ground, which has a program of its own
  bool faces = false;        // a brick: its three pairs of faces differ
  auto operator<=>(const SurfaceKey&) const = default;
};
// All of a body's part that its look follows from.
struct PartLook {
  std::string material;
  BodyRole role = BodyRole::body;
  std::uint32_t colour = 0;  // 0xRRGGBB
  std::uint32_t number = 0;  // of the body: its own colour goes by it
};
// Of what is drawn of the body, by its place.
PartLook partLook(const ListedBody& body, std::size_t part);
SurfaceKey surfaceOf(const PartLook& look, const ShapeDef& shape);
// Texture coordinates as the surface's textures want them.
DrawMesh drawMeshOf(const ShapeDef& shape, const SurfaceKey& surface);
// But for its pose.
Instance instanceOf(const PartLook& look, const SurfaceKey& surface);

class Looks {
 public:
  // fine: textures are filtered as a graphics card does without noticing.
  explicit Looks(bool fine);
  // Made when it is first asked for.
  Ogre::MaterialPtr material(const SurfaceKey& surface, ShadowMode shadows);
  // The polygon view: colours without light.
  void setFlat(bool flat);
  void setSun(Vec3 towardsSun);

 private:
  struct Textures {
    Ogre::TexturePtr look, relief;
  };
  Ogre::MaterialPtr makeSurface(const SurfaceKey& surface, ShadowMode shadows);
  const Textures& texturesOf(const SurfaceKey& surface);

  std::map<std::pair<SurfaceKey, ShadowMode>, Ogre::MaterialPtr> made_;
  std::map<SurfaceKey, Textures> textures_;
  Ogre::MaterialPtr caster_;
  bool fine_ = true, flat_ = false;
  Vec3 sun_{0, 1, 0};
};

}  // namespace brickfall::viewer
