// A world of rigid bodies and its step.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "brickfall/body.h"
#include "brickfall/broad_phase.h"
#include "brickfall/debug_draw.h"
#include "brickfall/events.h"
#include "brickfall/host.h"
#include "brickfall/ids.h"
#include "brickfall/integrators.h"
#include "brickfall/island_ending.h"
#include "brickfall/joint.h"
#include "brickfall/math.h"
#include "brickfall/mortar.h"
#include "brickfall/result.h"
#include "brickfall/shapes.h"
#include "brickfall/solver_settings.h"
#include "brickfall/step_report.h"

namespace brickfall {

struct WorldDef {
  Vec3 gravity{0, -9.81, 0};      // m/s2
  double airDensity = 1.204;      // kg/m3, for bodies with a drag area
  bool enableSleep = true;        // islands at rest for sleepDelay seconds cost nothing until something touches them
  double sleepDelay = 0.5;        // s, > 0
  double hitEventSpeed = 1.0;     // m/s: slower impacts make no hit event
  double hitEventImpulse = 0.01;  // N s: weaker impacts make no hit event
  int threads = 1;                // 1 .. 64: islands are solved side by side; results do not depend on it
  int maxBodies = 1'000'000;      // createBody fails beyond
  BroadPhaseMethod broadPhase = BroadPhaseMethod::tree;  // changes time only, no result
  Integrator integrator = Integrator::splitting;         // of bodies that touch nothing
  SolverSettings solver;
  // Of the program that the world is part of; each outlives the world, and stays for its life. Neither changes a result.
  TaskSystem* tasks = nullptr;                  // null: threads of its own, as many as `threads`; else that is not read
  std::pmr::memory_resource* memory = nullptr;  // of islands and steps, taken in large chunks; null: operator new
};

// One touching pair of bodies as the solver left it, in the last part of the step.
struct ContactPointView {
  Vec3 pointWorld;         // m
  double separation = 0;   // m, negative = overlap
  double normalForce = 0;  // N, on B along the normal; an impact within the step counts as its mean over the step
  Vec3 frictionForce;      // N, on B
};
struct ContactView {
  BodyId bodyA, bodyB;
  ShapeId shapeA, shapeB;
  Vec3 normalWorld;  // unit, from A to B
  int pointCount = 0;
  ContactPointView points[4];
};

// Bodies that hang together by contacts, joints or mortar, not through anything fixed, as the last step found them.
struct IslandView {
  std::span<const BodyId> bodies;  // dynamic; valid until the callback returns
  bool awake = true;
  IslandEnding ending = IslandEnding::unsolved;  // of its last solve
};

// What a contact will do in the coming step, for a program that wants to change it (World::setPreSolve).
struct PreSolveContact {
  BodyId bodyA, bodyB;
  ShapeId shapeA, shapeB;
  Vec3 normalWorld;       // unit, from A to B
  Vec3 pointWorld;        // m, its nearest point
  Vec3 velocityWorld;     // m/s, of B against A at that point: approaching where it goes against the normal
  double separation = 0;  // m, at that point; negative = overlap
  // May be changed, for this step:
  double friction = 0;     // 0 .. 100, as the two materials combine
  double restitution = 0;  // 0 .. 1
  bool enabled = true;     // false: the two shapes pass through each other
};

struct RayHit {
  BodyId body;
  ShapeId shape;
  Vec3 pointWorld;      // m
  Vec3 normalWorld;     // unit, out of the shape
  double distance = 0;  // m along the ray
};
struct ShapeCastHit {
  BodyId body;
  ShapeId shape;
  Vec3 pointWorld;   // m, of the shape that was hit; where they overlap at the start the middle of the one that asks
  Vec3 normalWorld;  // unit, out of it; 0 where the two overlap at the start
  double share = 0;  // 0 .. 1 of the motion until they touch; 0: they overlap at the start
};
struct ClosestResult {
  BodyId body;
  ShapeId shape;
  Vec3 pointWorld;      // m, nearest point of the shape
  double distance = 0;  // m, 0 inside
};

struct Energy {
  double kinetic = 0;    // J
  double potential = 0;  // J, of gravity: -sum m gravityScale g . x
};

class World {
 public:
  static Result<World> create(const WorldDef& def);
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  // --- Bodies. Every setter refuses non-finite values and stale ids and then changes nothing.
  Result<BodyId> createBody(const BodyDef& def);
  Status destroyBody(BodyId body);
  // The body is gone, and the pieces are there instead, with new ids in the order given: all of it or, on any error,
  // nothing. What touches it touches the pieces as before: their contacts go on with what the body's remembered within
  // 0.6 inner radii of the thinner shape, so that what leans on it is held all the while. Places and velocities are
  // those of the definitions. Forces applied for the next step go to the dynamic pieces: the sums of force and of
  // torque stay, and all of them gain speed as one rigid body would. Mortar that holds goes on, damage and all, with the
  // piece that has its whole face; where none has, it ends (Events::mortar, dropped).
  Result<std::vector<BodyId>> replaceBody(BodyId body, std::span<const BodyDef> pieces);
  bool isValid(BodyId body) const;
  Result<BodyState> state(BodyId body) const;
  Result<MassProperties> massProperties(BodyId body) const;  // in the body frame
  std::vector<BodyId> bodies() const;                        // in order of creation
  std::vector<ShapeId> shapes(BodyId body) const;            // empty for a stale id
  Result<ShapeDef> shape(ShapeId shape) const;
  Status setType(BodyId body, BodyType type);                      // velocities are kept; a fixed body loses them
  Status setTransform(BodyId body, Vec3 position, Quat rotation);  // teleports; contacts of the body are made anew
  Status setLinearVelocity(BodyId body, Vec3 velocity);
  Status setAngularVelocity(BodyId body, Vec3 velocity);
  Status setGravityScale(BodyId body, double scale);
  Status setDamping(BodyId body, double linear, double angular);
  Status setDragArea(BodyId body, double dragArea);
  // Of a fixed or kinematic body: see BodyDef::surfaceVelocity. setType ends it where the body becomes dynamic.
  Status setSurfaceVelocity(BodyId body, Vec3 velocity);
  // See BodyDef::massProperties; none: those of its shapes again. Velocities stay as they are. Where the centre of mass moves,
  // the body's contacts are made anew.
  Status setMassProperties(BodyId body, const std::optional<MassProperties>& properties);
  // See AxisLocks. Velocities along axes that are locked end; places stay as they are.
  Status setLocks(BodyId body, const AxisLocks& locks);
  // Switched off, a body stays where it is, keeps its velocity, and takes no part in anything: nothing touches it, no force
  // acts, queries and sensors go past it, its joints and mortar hold nothing. Setters work, pushes are refused. Switched on, it
  // goes on from there; what overlaps it by then is parted slowly. Costs as much as making a body, and keeps its ids.
  Status setEnabled(BodyId body, bool enabled);
  Status setGravity(Vec3 gravity);
  Vec3 gravity() const;
  Status wake(BodyId body);
  // All that hangs together with a dynamic body falls asleep in the next step if it rests in it, without waiting for sleepDelay.
  // Islands that move go on; so do those that may not sleep (enableSleep, BodyDef::allowSleep).
  Status sleep(BodyId body);
  // Another friction, restitution or density of a shape that is there. Contacts go on, with the new values; velocities stay as
  // they are. Where a new density moves the body's centre of mass, its contacts are made anew.
  Status setMaterial(ShapeId shape, const Material& material);
  // Whether setMaterial would take all of these for the body's shapes, one for each in the order of shapes(body), whichever comes
  // first; if not, why. Nothing changes: for who changes many bodies, all or none.
  Status checkMaterials(BodyId body, std::span<const Material> materials) const;

  // --- Joints (joint.h). What is not finite or out of range, and stale ids, are refused with the name of the field, and
  // then nothing changes. A joint wakes its bodies when it is made, changed or destroyed. It ends with either of its
  // bodies, silently, also when one is replaced or quarantined, and when it breaks (Events::breaks).
  Result<JointId> createJoint(const JointDef& def);
  Status destroyJoint(JointId joint);
  bool isValid(JointId joint) const;
  Result<JointState> state(JointId joint) const;
  Result<JointDef> definition(JointId joint) const;  // with anchors and axis where they are now, and what was set since
  std::vector<JointId> joints() const;               // in order of creation
  std::vector<JointId> joints(BodyId body) const;    // of the body, in order of creation; empty for a stale id
  Status setMotor(JointId joint, std::optional<JointDef::Motor> motor);  // revolute, prismatic
  Status setLimit(JointId joint, std::optional<JointDef::Limit> limit);  // spherical (twist), revolute, prismatic
  Status setLength(JointId joint, double length);                        // distance, rope, spring: a winch
  Status setTarget(JointId joint, Vec3 pointWorld);                      // drag: the point of A that it pulls to
  Status setBreaking(JointId joint, double breakForce, double breakTorque);

  // --- Mortar (mortar.h). Refused as joints are. It wakes its bodies when it is made or taken away. It ends with either of
  // its bodies, silently. Broken (Events::mortar), it stays valid and can be read, but ties nothing.
  Result<MortarId> createMortar(const MortarDef& def);
  Status destroyMortar(MortarId mortar);
  bool isValid(MortarId mortar) const;
  Result<MortarState> state(MortarId mortar) const;
  std::vector<MortarId> mortars() const;             // in order of creation, broken ones as well
  std::vector<MortarId> mortars(BodyId body) const;  // of the body, in order of creation; empty for a stale id
  // How the joint opened; refused for one that has not cracked.
  Result<MortarPast> past(MortarId mortar) const;
  // Which joint gave way first, and who bears its load since. Looks at all joints: many questions cost less with
  // FallFinder (fall.h).
  Result<FallStory> whyFell(BodyId body) const;
  // The outline of the face in which two bodies lie on each other, nearer than `gap` m: corners as MortarDef wants them,
  // in the middle of the gap. Empty where they do not lie face to face. Boxes and hulls, alone or in compounds, and planes; of
  // several such faces the largest. It is exact up to 16 corners; of more those are left out that cut off least.
  Result<std::vector<Vec3>> sharedFace(BodyId a, BodyId b, double gap = 1e-3) const;
  // Dynamic bodies that reach a fixed or kinematic one through mortar that holds, joints, or contacts that press.
  std::vector<BodyId> carried() const;

  // --- Settings, as the world has them now. All are changed at once, or none on an error. maxBodies, broadPhase, tasks,
  // memory and solver.contactMargin are for the life of a world: what differs there is refused. New loads or solver settings
  // wake who sleeps and end all rest; so does enableSleep = false.
  const WorldDef& definition() const;
  Status setDefinition(const WorldDef& def);

  // --- Forces act during the next step and are then forgotten; impulses act at once. Both wake the body.
  Status applyForce(BodyId body, Vec3 force);                              // N, at the centre of mass
  Status applyForceAtPoint(BodyId body, Vec3 force, Vec3 pointWorld);      // N
  Status applyTorque(BodyId body, Vec3 torque);                            // N m
  Status applyImpulse(BodyId body, Vec3 impulse);                          // N s, at the centre of mass
  Status applyImpulseAtPoint(BodyId body, Vec3 impulse, Vec3 pointWorld);  // N s
  Status applyAngularImpulse(BodyId body, Vec3 impulse);                   // N m s

  // --- Who may collide, besides CollisionFilter: asked for two shapes of two bodies whose filters allow it, the lower shape id
  // first; false: they never touch. It must answer by nothing but the two shapes, always the same: it is asked again whenever
  // the two come near each other, on the thread that steps, and never when they no longer are apart. It must not throw; calls
  // that change the world answer wrongState meanwhile. Set it before the bodies come that it is for: pairs that are near each
  // other already are not asked about. Sensors do not ask it. A snapshot does not hold it; restore keeps it. Empty: none.
  using ContactFilter = std::function<bool(ShapeId, ShapeId)>;
  Status setContactFilter(ContactFilter filter);

  // --- Before the solve. Called for each pair of shapes whose contact the coming step may use, those that do not touch yet as
  // well: in the order of their shapes, on the thread that steps, in every part of a step (StepReport::parts). What it changes
  // holds for that part; the next call starts from the materials again. Values out of range are taken as the nearest one, those
  // that are not numbers are left as they were. Islands that sleep are not asked about: wake what a change of mind concerns.
  // It must answer by nothing but the state of the world and of the program, or runs differ; calls that change the world answer
  // wrongState meanwhile. It must not throw. A contact that is switched off remembers nothing and tells no event. A snapshot
  // does not hold the callback; restore keeps it. Empty: none. It costs one call for each contact.
  using PreSolve = std::function<void(PreSolveContact&)>;
  Status setPreSolve(PreSolve callback);

  // --- Time. Advances by dt seconds (1e-5 .. 0.1), in `substeps` equal parts (1 .. 64), each of which is made in
  // up to SolverSettings::maxHitParts where something heavy hits, or twice as many where a part is taken again.
  // dt / substeps may vary from step to step: what rests goes on resting if the longest is no more than four times the shortest. Equal ones cost least.
  Result<StepReport> step(double dt, int substeps = 1);
  double time() const;  // s
  std::uint64_t stepCount() const;
  void trace(const TraceOptions& options);  // what the reports of the steps to come hold besides; changes no result
  const Events& events() const;             // of the last step

  // --- Queries, at the poses after the last step. Filter: shapes whose category is in the mask.
  Result<std::optional<RayHit>> castRay(Vec3 origin, Vec3 direction, double maxDistance,
                                        std::uint32_t mask = 0xffffffffu) const;
  // Every shape that the ray meets, each once, nearest first; of equal distances the lower shape id first.
  Result<std::vector<RayHit>> castRayAll(Vec3 origin, Vec3 direction, double maxDistance,
                                         std::uint32_t mask = 0xffffffffu) const;
  // A shape that goes by `motion` m (each component up to 1e7) from where a body at `from` would have it, without a turn: the
  // first shape that it meets, or the lower shape id of several at once. Any shape but planes and meshes; its material, filter
  // and place of mass are not read. It stops short by at most 1e-5 of the smaller inner radius. One side of a mesh: its front.
  Result<std::optional<ShapeCastHit>> castShape(const ShapeDef& shape, const Transform& from, Vec3 motion,
                                                std::uint32_t mask = 0xffffffffu) const;
  // Shapes that overlap one, as it would lie on a body at `pose`; by shape id. Any shape but planes and meshes.
  Result<std::vector<ShapeId>> overlapShape(const ShapeDef& shape, const Transform& pose,
                                            std::uint32_t mask = 0xffffffffu) const;
  Result<std::vector<BodyId>> overlapBox(const Aabb& box,
                                         std::uint32_t mask = 0xffffffffu) const;  // bounds, exact shape
  Result<std::vector<BodyId>> overlapSphere(Vec3 centre, double radius, std::uint32_t mask = 0xffffffffu) const;
  Result<std::optional<ClosestResult>> closest(Vec3 point, double maxDistance, std::uint32_t mask = 0xffffffffu) const;
  // While forEachContact, forEachIsland or draw runs its callbacks, calls that change the world answer wrongState; reading is
  // fine. The callbacks must not throw.
  void forEachContact(const std::function<void(const ContactView&)>& visit) const;
  // Awake islands, then those that sleep, each in the order of their lowest body. Bodies without contacts, joints
  // and mortar are in none.
  void forEachIsland(const std::function<void(const IslandView&)>& visit) const;
  // Exact overlap depth of two shapes, m: 0 when apart. What is really there, not what the solver believes.
  Result<double> penetration(ShapeId a, ShapeId b) const;
  Energy energy() const;         // of dynamic bodies
  Vec3 linearMomentum() const;   // kg m/s, of dynamic bodies
  Vec3 angularMomentum() const;  // kg m2/s, about the world's origin

  // --- State as a whole
  std::uint64_t stateHash() const;  // over the bits of all poses and velocities, in order of creation
  std::vector<std::byte> snapshot() const;
  Status restore(std::span<const std::byte> snapshot);  // on any error the world stays as it was
  // Every invariant of every part; empty = all hold. For tests and for finding our bugs.
  std::vector<std::string> validate() const;
  void draw(const DebugDraw& draw) const;

 private:
  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// What every call that takes a material asks of it by itself; the error names the field.
Status checkMaterial(const Material& material);

// "0.1.0"
const char* versionString();

}  // namespace brickfall
