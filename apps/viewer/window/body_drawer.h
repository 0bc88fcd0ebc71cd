// Draws the bodies of a frame: equal shapes of one material are one batch. Made anew only when somebody comes or goes; a picture
// fills in poses and colours.
#pragma once
#include <OgrePrerequisites.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "viewer_window/depth_shadows.h"
#include "viewer_window/instance_batch.h"
#include "viewer_window/looks.h"
#include "viewer_window/renderer.h"
#include "viewer_window/shadow_volumes.h"
#include "viewer_window/view_options.h"

namespace brickfall::viewer {

class BodyDrawer {
 public:
  explicit BodyDrawer(Renderer& renderer);
  ~BodyDrawer();
  // Materials and casters for another kind of shadow.
  void setShadows(ShadowMode mode);
  void setSun(Vec3 towardsSun);
  void draw(const Frame& frame, double blend, const ViewOptions& options, const View& view, Serial glowing);
  int batches() const { return int(batches_.size()); }

 private:
  struct Batch {
    std::unique_ptr<InstanceBatch> drawn;
    std::unique_ptr<ShadowShape> shadow;
    SurfaceKey surface;
    std::vector<Instance> instances;
  };
  // A shape of a body.
  struct Piece {
    int body = 0;  // place in the list
    Batch* batch = nullptr;
    Transform local;
    Vec3 scale{1, 1, 1};
    Instance usual;  // but for its pose
    bool casts = true, ball = false;
  };
  void list(const BodyList& bodies);
  Batch& batchFor(const ShapeDef& shape, const PartLook& look);
  void drawMortar(const Frame& frame, double blend, const ViewOptions& options);
  void useMaterial(Batch& batch);
  static void tint(Instance& instance, const BodyTint& tint, bool flat);
  void castShadows(const Frame& frame, double blend, const View& view);

  Renderer& renderer_;
  Ogre::SceneNode* node_ = nullptr;
  Looks looks_;
  DepthShadows depth_;
  ShadowVolumesFactory volumesFactory_;
  ShadowVolumes* volumes_ = nullptr;
  ShadowGeometry geometry_;
  std::shared_ptr<const BodyList> listed_;
  std::map<std::pair<SurfaceKey, std::string>, Batch> batches_;  // by surface and shape
  std::vector<Piece> pieces_;
  std::unique_ptr<InstanceBatch> plates_;  // joints by their numbers; made when they are first shown
  SurfaceKey plateSurface_;
  ShadowMode shadows_ = ShadowMode::none;
  Vec3 sun_{0, 1, 0};
  bool flat_ = false;
};

}  // namespace brickfall::viewer
