// The contents of a world: bodies, their shapes, and the ids by which a program names them. The registry knows the
// parts of a body and its place. It does not know the body's contacts or whether it is awake.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/findings.h"
#include "brickfall/body.h"
#include "brickfall/ids.h"
#include "brickfall/result.h"
#include "dynamics/body_set.h"
#include "dynamics/shape_set.h"

namespace brickfall {

// A body that passed all checks: making it can't fail any more.
struct BodyPlan {
  const BodyDef* def = nullptr;              // outlives the plan
  std::vector<std::unique_ptr<Hull>> hulls;  // by shape; null but for hulls
};

// The slot that an id names. `has(slot)`: the slot is in use by what had this generation; `kind`: for the message.
template <class Id, class Has>
Result<std::uint32_t> slotOf(Id id, std::uint16_t world, const std::string& kind, Has&& has) {
  if (id.index == 0) return Error{ErrorCode::staleId, kind + ": the id is null"};
  if (id.world != world) return Error{ErrorCode::staleId, kind + ": the id is of another world"};
  if (!has(id.index - 1))
    return Error{ErrorCode::staleId, kind + ": id " + std::to_string(id.index) + " was destroyed"};
  return id.index - 1;
}

class Registry {
 public:
  BodySet bodies;
  ShapeSet shapes;
  std::uint16_t worldNumber = 0;  // in ids
  int dynamicBodies = 0;
  std::vector<ShapeIndex> sensors;  // ascending

  Result<BodyIndex> find(BodyId id) const;
  Result<ShapeIndex> find(ShapeId id) const;
  BodyId idOf(BodyIndex body) const { return {body + 1, bodies.data[body].generation, worldNumber}; }
  ShapeId idOfShape(ShapeIndex shape) const { return {shape + 1, shapes.data[shape].generation, worldNumber}; }

  BodyIndex add(BodyPlan&& plan);
  void remove(BodyIndex body);
  // A fixed body loses its velocities.
  void setType(BodyIndex body, BodyType type);
  void setLocks(BodyIndex body, std::uint8_t locks);
  void keepLocks(BodyIndex body);                              // its velocities along locked axes end
  void setPose(BodyIndex body, Vec3 position, Quat rotation);  // of the body's frame
  // True if the body's centre of mass is elsewhere in it than before; its frame stays where it is.
  bool setMaterial(ShapeIndex shape, const Material& material);
  bool setMass(BodyIndex body, const std::optional<MassProperties>& given);  // true: as setMaterial
  // kg, if the body's shapes were of these; what was given instead of their mass, if it was.
  double massWith(BodyIndex body, std::span<const Material> materials) const;
  double massOfShapes(BodyIndex body, std::span<const Material> materials) const;
  bool hasMesh(BodyIndex body) const;
  bool mayMeet(ShapeIndex a, ShapeIndex b) const;  // of two bodies, one is dynamic, and their filters allow it

  // For bodies that were read from a snapshot: works out all that follows from their definitions.
  Status rebuild();

  // Counts, indices and links must hold before anything may be followed; `check` looks at all the rest.
  void checkStructure(Findings& f) const;
  void check(Findings& f) const;

 private:
  void updateMass(BodyIndex body, Vec3 origin);
  bool renewMass(BodyIndex body);  // true if the centre of mass is elsewhere in the body
};

// The hull of a shape that is one; null of others.
Result<std::unique_ptr<Hull>> hullOf(const ShapeDef& def);
// The shape as geometry; `hull` of hulls.
Shape geometryOf(const ShapeDef& def, const Hull* hull);

}  // namespace brickfall
