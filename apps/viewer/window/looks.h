// How bodies look, as the window draws it: meshes of shapes, and a material for each kind of surface.
#pragma once
#include <OgrePrerequisites.h>

#include <map>
#include <string>

#include "viewer_core/frame.h"
#include "viewer_window/draw_mesh.h"
#include "viewer_window/instance_batch.h"
#include "viewer_window/renderer.h"

namespace brickfall::viewer {

// Of a body: which surface, and what varies from body to body.
struct BodyLook {
  std::string surface;  // "brick", "steel" ...
  Instance usual;       // colour, texture place, brightness; no pose
};

// Spheres share one mesh, of radius 1 m, whatever their size.
bool isScaled(const ShapeDef& shape);
DrawMesh drawMeshOf(const ShapeDef& shape);
// Equal for shapes with the same mesh.
std::string meshKey(const ShapeDef& shape);
BodyLook lookOf(const ListedBody& body);

class Looks {
 public:
  Looks();
  // Of a surface, for one kind of shadow; made when it is first asked for.
  Ogre::MaterialPtr material(const std::string& surface, ShadowMode shadows);
  // The polygon view: colours without light.
  void setFlat(bool flat);

 private:
  Ogre::MaterialPtr makeSurface(const std::string& surface, bool depth);
  void makeCaster();

  std::map<std::string, Ogre::MaterialPtr> made_;
  Ogre::MaterialPtr caster_;
  bool flat_ = false;
};

}  // namespace brickfall::viewer
