// The table of keys.
#include "scene/keys.h"

#include <map>
#include <utility>

#include "brickfall/limits.h"
#include "scene/node.h"
#include "scene/shape_choices.h"

namespace brickfall::scene {
namespace {

using K = KeyKind;
constexpr double kFar = scene_limits::kLargestCoordinate, kFast = scene_limits::kLargestSpeed;
constexpr double kLate = 86400;  // s
constexpr double kSmall = scene_limits::kSmallestSize, kLarge = scene_limits::kLargestSize;

// One row a key, wider than a page.
// clang-format off
// What places a body and lets it move: the same for [[body]], [[ball]] and [[array]].
void addMotion(std::vector<KeySpec>& keys, const char* table) {
  keys.push_back({table, "velocity", K::vector, "m/s", -kFast, kFast, "[0, 0, 0]", "", "velocity of the centre of mass"});
  keys.push_back({table, "angular_velocity", K::vector, "rad/s", -kFast, kFast, "[0, 0, 0]", "", "about the world's axes"});
  keys.push_back({table, "gravity_scale", K::number, "", -limits::kLargestGravityScale, limits::kLargestGravityScale, "1", "", "share of the world's gravity"});
  keys.push_back({table, "linear_damping", K::number, "1/s", 0, 1000, "0", "", "velocity decays as exp(-damping t)"});
  keys.push_back({table, "angular_damping", K::number, "1/s", 0, 1000, "0", "", "the same for the spin"});
  keys.push_back({table, "drag_area", K::number, "m2", 0, 1000, "0", "", "Cd A of quadratic air drag; 0 = no drag"});
  keys.push_back({table, "allow_sleep", K::boolean, "", 0, 0, "true", "", "false keeps it and what touches it awake"});
}

// How a body is let go: the same for [[body]] and [[ball]].
void addLaunch(std::vector<KeySpec>& keys, const char* table) {
  keys.push_back({table, "launch_time", K::number, "s", 0, kLate, "0", "", "held in place until then"});
  keys.push_back({table, "launch_times", K::times, "s", 0, kLate, "-", "", "several shots: at each time one more such body appears, name/0, name/1, ..."});
  keys.push_back({table, "target", K::vector, "m", -kFar, kFar, "-", "", "with `speed`, instead of `velocity`: a point that it flies through"});
  keys.push_back({table, "aim_at", K::name, "", 0, 0, "-", "", "instead of `target`: a body, a wall, a group, ..., at its middle at the start"});
  keys.push_back({table, "speed", K::number, "m/s", 0.001, kFast, "-", "", "of the shot at `target` or `aim_at`"});
  keys.push_back({table, "high_shot", K::boolean, "", 0, 0, "false", "", "of the two ways to `target` the higher"});
}

void addShape(std::vector<KeySpec>& keys, const char* table) {
  keys.push_back({table, "shape", K::choice, "", 0, 0, "\"box\"", kShapeChoices, "form"});
  keys.push_back({table, "size", K::positive, "m", kSmall, kLarge, "[1, 1, 1]", "", "box: whole lengths along x, y, z"});
  keys.push_back({table, "radius", K::number, "m", kSmall, kLarge, "0.5", "", "sphere, capsule, cylinder, and a cone at its foot"});
  keys.push_back({table, "height", K::number, "m", kSmall, kLarge, "1", "", "along y: of a cylinder or cone; of a capsule between the centres of its caps"});
  keys.push_back({table, "top_radius", K::number, "m", 0, kLarge, "0", "", "cone: at its top; 0 is a point"});
  keys.push_back({table, "vertices", K::points, "m", -kLarge, kLarge, "-", "", "hull: 4 .. 64 points that span a volume"});
  keys.push_back({table, "file", K::text, "", 1, 1000, "-", "", "mesh: an .obj, .gltf or .glb file, or heights as .csv, relative to the scene file"});
  keys.push_back({table, "scale", K::positive, "", 1e-6, 1e6, "-", "", "mesh: factors along x, y, z; default 1; of heights, the spacing along x and z"});
}

// The numbers of a mortar: of a kind, of a wall's or arch's own, and of [[mortar]].
void addMortarNumbers(std::vector<KeySpec>& keys, const char* table) {
  keys.push_back({table, "tension", K::number, "Pa", 1, 1e9, "-", "", "flexural bond strength: pull at the edge of a mortar joint"});
  keys.push_back({table, "cohesion", K::number, "Pa", 1, 1e9, "-", "", "shear strength without pressure; more than tension x friction"});
  keys.push_back({table, "friction", K::number, "", 0, 10, "-", "", "what pressure adds to it"});
  keys.push_back({table, "tension_energy", K::number, "J/m2", 1e-6, 1e6, "-", "", "that opening a mortar joint takes"});
  keys.push_back({table, "shear_energy", K::number, "J/m2", 1e-6, 1e6, "-", "", "that shearing it off takes"});
  keys.push_back({table, "compression", K::number, "Pa", 1, 1e10, "-", "", "crushing strength, at the edge of a mortar joint"});
  keys.push_back({table, "crushing_energy", K::number, "J/m2", 1e-6, 1e9, "-", "", "that crushing a mortar joint takes"});
  keys.push_back({table, "stiffness", K::number, "N/m3", 1e6, 1e13, "-", "", "of a mortar joint, with what gives in its bricks"});
  keys.push_back({table, "density", K::number, "kg/m3", scene_limits::kSmallestDensity, scene_limits::kLargestDensity, "-", "", "of the mortar"});
  keys.push_back({table, "head_filling", K::number, "", 0, 1, "-", "", "share of upright joints that is filled: they are so much weaker; 0: they are open"});
  keys.push_back({table, "scatter", K::number, "", 0, 1, "-", "", "coefficient of variation of strengths and energies from one to the next (log-normal)"});
}

// One function a table, in the order of docs/scene-file.md.
void addSceneKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"", "title", K::text, "", 0, 200, "\"\"", "", "what the scene shows, in a line"});
  keys.push_back({"", "description", K::text, "", 0, 10000, "\"\"", "", "more about it"});
  keys.push_back({"", "include", K::texts, "", 0, 0, "-", "", "other scene files, relative to this one: their tables come first, what this one says counts"});
  keys.push_back({"", "parameters", K::parameters, "", 0, 0, "-", "", "named numbers for expressions"});
  keys.push_back({"", "world", K::table, "", 0, 0, "-", "", "gravity, time and sleep"});
  keys.push_back({"", "solver", K::table, "", 0, 0, "-", "", "advanced settings of the contact solver"});
  keys.push_back({"", "report", K::table, "", 0, 0, "-", "", "parts of the report's system, with method = \"report\""});
  keys.push_back({"", "ground", K::table, "", 0, 0, "-", "", "what everything stands on"});
  keys.push_back({"", "material", K::tables, "", 0, 0, "-", "", "materials by name"});
  keys.push_back({"", "brick_kind", K::tables, "", 0, 0, "-", "", "kinds of brick by name"});
  keys.push_back({"", "mortar_kind", K::tables, "", 0, 0, "-", "", "kinds of mortar by name"});
  keys.push_back({"", "wall", K::tables, "", 0, 0, "-", "", "walls of bricks"});
  keys.push_back({"", "pier", K::tables, "", 0, 0, "-", "", "piers of bricks that stand by themselves"});
  keys.push_back({"", "roof", K::tables, "", 0, 0, "-", "", "pitched roofs of trusses and boards"});
  keys.push_back({"", "body", K::tables, "", 0, 0, "-", "", "bodies placed one by one"});
  keys.push_back({"", "ball", K::tables, "", 0, 0, "-", "", "balls to throw"});
  keys.push_back({"", "array", K::tables, "", 0, 0, "-", "", "many equal bodies: lattices, columns, pyramids, piles"});
  keys.push_back({"", "arch", K::tables, "", 0, 0, "-", "", "arches of wedge-shaped stones"});
  keys.push_back({"", "dome", K::tables, "", 0, 0, "-", "", "domes of wedge-shaped stones, with a drum under them"});
  keys.push_back({"", "group", K::tables, "", 0, 0, "-", "", "tables that stand together, to be placed and copied as one"});
  keys.push_back({"", "copy", K::tables, "", 0, 0, "-", "", "another one of a table that has a name, at its own place"});
  keys.push_back({"", "mortar", K::tables, "", 0, 0, "-", "", "mortar between bodies that lie on each other"});
  keys.push_back({"", "joint", K::tables, "", 0, 0, "-", "", "what ties two bodies"});
  keys.push_back({"", "chain", K::tables, "", 0, 0, "-", "", "rows of links or boards with their joints"});
  keys.push_back({"", "tilt", K::tables, "", 0, 0, "-", "", "tables that turn"});
  keys.push_back({"", "shake", K::tables, "", 0, 0, "-", "", "tables that shake: records, sines, pulses"});
  keys.push_back({"", "wind", K::tables, "", 0, 0, "-", "", "air that moves"});
  keys.push_back({"", "blast", K::tables, "", 0, 0, "-", "", "impulses that spread from a point"});
  keys.push_back({"", "camera", K::tables, "", 0, 0, "-", "", "views for the replay"});
}

void addWorldKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"world", "gravity", K::gravity, "m/s2", -1000, 1000, "9.81", "", "downwards, or a vector [x, y, z]"});
  keys.push_back({"world", "seconds", K::number, "s", 0.001, 86400, "10", "", "simulated time of a run"});
  keys.push_back({"world", "stop_when", K::choice, "", 0, 0, "\"time\"", "time|rest", "the run ends after `seconds`, or earlier: when all rests and nothing is to come"});
  keys.push_back({"world", "remove_below", K::number, "m", -kFar, kFar, "-", "", "height: bodies whose centres fall lower are taken out; default: none"});
  keys.push_back({"world", "time_step", K::number, "s", limits::kShortestTimeStep, limits::kLongestTimeStep, "0.016666666666666666", "", "dt of one step; smaller is truer and slower"});
  keys.push_back({"world", "substeps", K::integer, "", 1, limits::kMostSubsteps, "1", "", "equal parts that each step is solved in"});
  keys.push_back({"world", "frames_per_second", K::number, "1/s", 0.1, 10000, "60", "", "frames recorded per simulated second"});
  keys.push_back({"world", "seed", K::integer, "", 0, 9007199254740992.0, "1", "", "of every random number in the scene"});
  keys.push_back({"world", "sleep", K::boolean, "", 0, 0, "true", "", "what rests costs nothing until something touches it"});
  keys.push_back({"world", "sleep_delay", K::number, "s", 0.001, 1000, "0.5", "", "at rest for so long before it sleeps"});
  keys.push_back({"world", "air_density", K::number, "kg/m3", 0, 2000, "1.204", "", "for bodies with a drag_area"});
  keys.push_back({"world", "hit_event_speed", K::number, "m/s", 0, kFast, "1", "", "slower impacts make no hit event"});
  keys.push_back({"world", "broad_phase", K::choice, "", 0, 0, "\"tree\"", "tree|sweep_and_prune|bounding_spheres|all_pairs", "how pairs that may touch are found; changes no result (docs/broad-phases.md)"});
  keys.push_back({"world", "method", K::choice, "", 0, 0, "\"clusters\"", "clusters|report", "the engine, or the system of the report that it came from, for comparison (docs/report.md)"});
  keys.push_back({"world", "integrator", K::choice, "", 0, 0, "\"splitting\"", "splitting|explicit_euler|semi_implicit_euler|implicit_euler_rotation|velocity_verlet|runge_kutta_4", "how bodies that touch nothing move (docs/integrators.md)"});
  keys.push_back({"world", "hit_event_impulse", K::number, "N s", 0, 1e9, "0.01", "", "weaker impacts make no hit event"});
}

void addSolverKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"solver", "resting_stiffness", K::number, "u", 10, 1e5, "1000", "", "of resting contacts; u = effective mass / time_step^2; islands of 25 bodies and more that are not solved directly take a part of it at steps under 1/60 s"});
  keys.push_back({"solver", "impact_stiffness", K::number, "u", 1, 1e5, "30", "", "of a contact born in an impact; at most resting_stiffness"});
  keys.push_back({"solver", "resting_approach_speed", K::number, "m/s", 0, 100, "0.3", "", "contacts born slower are resting, not impacts"});
  keys.push_back({"solver", "restitution_speed", K::number, "m/s", 0, 100, "1", "", "slower impacts do not rebound; few bodies (an island of up to five, balls in a row) bounce on until a hundredth of gravity x time_step"});
  keys.push_back({"solver", "contact_margin", K::number, "m", 1e-5, 1, "0.01", "", "contacts are made this early, and earlier by what moves"});
  keys.push_back({"solver", "rest_speed", K::number, "m/s", 0, 1, "0.01", "", "only slower islands are stopped or put to rest; large ones up to 0.03 m/s are stopped too, where a swing ends"});
  keys.push_back({"solver", "rest_tolerance", K::number, "", 0, 1, "0.001", "", "force residual / max(weight, 0.02 load) taken as: nothing moves"});
  keys.push_back({"solver", "cycle_tolerance", K::number, "", 1e-6, 1, "0.02", "", "residual / max(weight, 0.3 load) under which a body of a large moving island is left alone"});
  keys.push_back({"solver", "min_cycles", K::integer, "", 1, 64, "4", "", "fewest cycles of a step, unless a cycle moves nothing; islands of 2 to 24 bodies, which are solved directly, get one; at most max_cycles"});
  keys.push_back({"solver", "max_cycles", K::integer, "", 1, 256, "10", "", "cycles of large islands; up to three times as many while a twentieth of one is out of balance"});
  keys.push_back({"solver", "max_cycles_alone", K::integer, "", 1, 256, "64", "", "cycles of a body that is alone in its island"});
  keys.push_back({"solver", "max_cycles_small", K::integer, "", 1, 256, "-", "", "old name of max_cycles_alone: still read, with a warning"});
  keys.push_back({"solver", "max_hit_parts", K::integer, "", 1, 64, "8", "", "a step in which something ten times as heavy goes far into what it hits is made in up to so many parts, in up to twice as many where bodies end deep in each other; 1: never"});
}

void addReportKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"report", "all_axes", K::boolean, "", 0, 0, "false", "", "all 15 axes at every test, the widest gap is remembered; false: the first that separates"});
  keys.push_back({"report", "last_axis", K::boolean, "", 0, 0, "false", "", "contact axis: the last to stop separating"});
  keys.push_back({"report", "restitution", K::boolean, "", 0, 0, "false", "", "impulses from masses, inertia and restitution; false: impulse_factor x speed"});
  keys.push_back({"report", "friction", K::boolean, "", 0, 0, "false", "", "Coulomb friction; false: damping"});
  keys.push_back({"report", "manifold", K::boolean, "", 0, 0, "false", "", "all points of contact, and overlap is pushed out; false: one point"});
  keys.push_back({"report", "warm_starting", K::boolean, "", 0, 0, "false", "", "impulses remembered, and sweeps over all contacts"});
  keys.push_back({"report", "impulse_factor", K::number, "", 0, 100, "1.5", "", "of reduced mass x closing speed"});
  keys.push_back({"report", "damping", K::number, "1/s", 0, limits::kLargestDamping, "0.3", "", "of all velocities, without friction"});
  keys.push_back({"report", "sweeps", K::integer, "", 1, 1000, "10", "", "with warm_starting"});
  keys.push_back({"report", "integrator", K::choice, "", 0, 0, "\"semi_implicit_euler\"", "splitting|explicit_euler|semi_implicit_euler|implicit_euler_rotation|velocity_verlet|runge_kutta_4", "how its bodies move"});
}

void addGroundKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"ground", "enabled", K::boolean, "", 0, 0, "true", "", "false: nothing to fall on"});
  keys.push_back({"ground", "type", K::choice, "", 0, 0, "\"plane\"", "plane|box", "an endless plane, or a box with its top at `height`"});
  keys.push_back({"ground", "height", K::number, "m", -kFar, kFar, "0", "", "of its surface, at the origin"});
  keys.push_back({"ground", "size", K::positive, "m", kSmall, 2 * limits::kLargestSize, "[100, 1, 100]", "", "of a box"});
  keys.push_back({"ground", "tilt_degrees", K::number, "degrees", -90, 90, "0", "", "turned about tilt_axis through the origin"});
  keys.push_back({"ground", "tilt_axis", K::vector, "", -1e3, 1e3, "[0, 0, 1]", "", "direction of the axis of the tilt"});
  keys.push_back({"ground", "material", K::material, "", 0, 0, "\"concrete\"", "", "its material"});
}

void addMaterialKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"material", "name", K::name, "", 0, 0, "", "", "what other tables call it"});
  keys.push_back({"material", "density", K::number, "kg/m3", scene_limits::kSmallestDensity, scene_limits::kLargestDensity, "1900", "", "mass by volume"});
  keys.push_back({"material", "friction", K::number, "", 0, limits::kLargestFriction, "0.6", "", "Coulomb coefficient"});
  keys.push_back({"material", "restitution", K::number, "", 0, 1, "0", "", "rebound speed / impact speed; in heaps impacts slower than restitution_speed do not rebound"});
  keys.push_back({"material", "rolling_resistance", K::number, "", 0, limits::kLargestFriction, "0", "", "torque that rolling takes / (normal force x radius); the larger of two counts"});
  keys.push_back({"material", "friction_rule", K::choice, "", 0, 0, "\"geometric_mean\"", "geometric_mean|average|minimum|multiply|maximum", "how two materials' values become one"});
  keys.push_back({"material", "hardness", K::number, "Pa", 1e3, 1e13, "60e6", "", "pressure at which a blow crushes it, where something round hits what mortar holds; of what crushes first"});
  keys.push_back({"material", "restitution_rule", K::choice, "", 0, 0, "\"maximum\"", "geometric_mean|average|minimum|multiply|maximum", "the same for restitution"});
  keys.push_back({"material", "colour", K::colour, "", 0, 0, "\"#B5543A\"", "", "of what is made from it"});
}

void addMortarKindKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"mortar_kind", "name", K::name, "", 0, 0, "", "", "what other tables call it"});
  addMortarNumbers(keys, "mortar_kind");
}

void addBrickKindKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"brick_kind", "name", K::name, "", 0, 0, "", "", "what walls call it"});
  keys.push_back({"brick_kind", "size", K::positive, "m", kSmall, 100, "[0.215, 0.065, 0.1025]", "", "length, height, width"});
  keys.push_back({"brick_kind", "frog", K::pair, "m", kSmall, 100, "-", "", "length and width of a hollow in the upper face"});
  keys.push_back({"brick_kind", "frog_floor", K::pair, "m", 0, 100, "-", "", "length and width at its floor; default: as at the face"});
  keys.push_back({"brick_kind", "frog_depth", K::number, "m", kSmall, 100, "-", "", "how deep it is"});
  keys.push_back({"brick_kind", "holes", K::wholePair, "", 1, 100, "-", "", "upright round holes, evenly spaced: along and across"});
  keys.push_back({"brick_kind", "hole_radius", K::number, "m", limits::kSmallestSize, 100, "-", "", "of each"});
  keys.push_back({"brick_kind", "material", K::material, "", 0, 0, "\"brick\"", "", "of walls of it that name no other"});
}

void addWallKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"wall", "name", K::name, "", 0, 0, "-", "", "bricks are called name/course/position"});
  keys.push_back({"wall", "bond", K::choice, "", 0, 0, "\"running\"", "running|header|english|flemish|stack", "how the bricks overlap"});
  keys.push_back({"wall", "bond_shift", K::number, "brick lengths", 0, 0.999, "0.5", "", "running bond: shift of every second course"});
  keys.push_back({"wall", "courses", K::integer, "", 1, 10000, "10", "", "layers of bricks"});
  keys.push_back({"wall", "bricks", K::integer, "", 1, 10000, "10", "", "whole bricks in a full course; sets the length"});
  keys.push_back({"wall", "brick", K::brick, "m", kSmall, 100, "\"uk\"", "", "a kind of brick, or [length, height, width] of a solid one"});
  keys.push_back({"wall", "half_bats", K::boolean, "", 0, 0, "true", "", "ends closed by cut bricks; false: whole bricks, toothed ends"});
  keys.push_back({"wall", "head_joint", K::number, "m", 0, 1, "0", "", "gap between neighbours in a course"});
  keys.push_back({"wall", "bed_joint", K::number, "m", 0, 1, "0", "", "gap between courses"});
  keys.push_back({"wall", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "left end of the foot, middle of the thickness"});
  keys.push_back({"wall", "yaw_degrees", K::number, "degrees", -3600, 3600, "0", "", "about the vertical; 0: along +x, 90: along -z"});
  keys.push_back({"wall", "material", K::material, "", 0, 0, "\"brick\"", "", "of the bricks"});
  keys.push_back({"wall", "lintel_material", K::material, "", 0, 0, "\"concrete\"", "", "of the lintels"});
  keys.push_back({"wall", "mortar", K::mortar, "", 0, 0, "\"none\"", "", "what holds the bricks together: a kind of mortar, \"none\", or [wall.mortar]"});
  keys.push_back({"wall", "foot", K::boolean, "", 0, 0, "false", "", "with mortar: the lowest course is mortared to what it stands on"});
  keys.push_back({"wall", "density_scatter", K::number, "", 0, 0.5, "0", "", "each brick's density times 1 +- up to this"});
  keys.push_back({"wall", "density_gradient", K::number, "", 0, 0.2, "0", "", "in each brick density differs linearly along each axis, by up to this from the middle to a face"});
  keys.push_back({"wall", "density_noise", K::number, "", 0, 0.2, "0", "", "in each brick sixteen equal parts differ in density, by up to this"});
  keys.push_back({"wall", "disorder", K::number, "m", 0, 0.01, "0", "", "bricks out of true by gaps of up to this"});
  keys.push_back({"wall", "shuffle", K::boolean, "", 0, 0, "false", "", "bricks are created in random order"});
  keys.push_back({"wall", "colour", K::colour, "", 0, 0, "-", "", "of its bricks; default: the material's"});
  keys.push_back({"wall", "path", K::planPoints, "m", -10000, 10000, "-", "", "corners of its middle line, from `position`: [[x, z], ...]; sets the length instead of `bricks`"});
  keys.push_back({"wall", "closed", K::boolean, "", 0, 0, "false", "", "with a path: its last corner is joined to its first"});
  keys.push_back({"wall", "radius", K::number, "m", 0, 10000, "0", "", "a round wall about `position`: of its middle line; 0: it is straight"});
  keys.push_back({"wall", "arc_degrees", K::number, "degrees", 1, 360, "360", "", "of a round wall, from +z towards +x; 360: a ring"});
  keys.push_back({"wall", "gable_degrees", K::number, "degrees", 0, 80, "0", "", "slope of a gable on top of it; 0: none"});
  keys.push_back({"wall", "gable_sides", K::numbers, "", 0, 999, "-", "", "sides of a path with a gable, the first is 0; default: all"});
  keys.push_back({"wall", "tied_to", K::texts, "", 0, 0, "-", "", "walls that its ends go into, in every second course"});
  keys.push_back({"wall", "opening", K::tables, "", 0, 0, "-", "", "doors and windows"});
  keys.push_back({"wall", "pier", K::tables, "", 0, 0, "-", "", "piers that are bonded into it"});
}

void addOwnMortarKeys(std::vector<KeySpec>& keys, const char* table) {
  keys.push_back({table, "kind", K::mortarKind, "", 0, 0, "\"cement\"", "", "the kind that has what is not given here"});
  addMortarNumbers(keys, table);
}

void addOpeningKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"wall.opening", "from", K::number, "m", 0, kFar, "", "", "left reveal, from the wall's left end"});
  keys.push_back({"wall.opening", "sill", K::number, "m", 0, kFar, "0", "", "above the wall's foot; 0 = door"});
  keys.push_back({"wall.opening", "width", K::number, "m", 0.01, kLarge, "", "", "clear width"});
  keys.push_back({"wall.opening", "height", K::number, "m", 0.01, kLarge, "", "", "clear height"});
  keys.push_back({"wall.opening", "lintel_bearing", K::number, "m", 0.01, 100, "0.15", "", "how far the lintel reaches into the wall"});
  keys.push_back({"wall.opening", "lintel_height", K::number, "m", 0, 100, "0.065", "", "in whole courses, rounded; 0 = no lintel"});
}

void addPierKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"wall.pier", "at", K::number, "m", 0, kFar, "", "", "its middle, along the wall; it ends with the wall at its ends"});
  keys.push_back({"wall.pier", "width", K::number, "brick lengths", 1, 100, "1.5", "", "along the wall, in halves"});
  keys.push_back({"wall.pier", "depth", K::number, "brick lengths", 1, 100, "1.5", "", "through the wall, in halves; 1.5 at least in a wall as thick as a brick is long"});
  keys.push_back({"wall.pier", "higher", K::integer, "", 0, 10000, "0", "", "courses above those of the wall"});
  keys.push_back({"pier", "name", K::name, "", 0, 0, "-", "", "bricks are called name/course/position"});
  keys.push_back({"pier", "width", K::number, "brick lengths", 1, 100, "1.5", "", "along x, in halves"});
  keys.push_back({"pier", "depth", K::number, "brick lengths", 1, 100, "1.5", "", "along z, in halves"});
  for (const char* key : {"courses", "brick", "head_joint", "bed_joint", "yaw_degrees", "material", "mortar", "foot", "density_scatter", "disorder", "colour"})
    for (const KeySpec& spec : std::vector<KeySpec>(keys))
      if (std::string_view(spec.table) == "wall" && std::string_view(spec.key) == key) {
        KeySpec same = spec;
        same.table = "pier";
        keys.push_back(same);
        break;
      }
  keys.push_back({"pier", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "middle of its foot"});
}

void addRoofKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"roof", "name", K::name, "", 0, 0, "-", "", "trusses are called name/truss/0, ..., boards name/front/0, ... and name/back/0, ..."});
  keys.push_back({"roof", "length", K::number, "m", 0.1, 1000, "4", "", "along the ridge, from wall to wall: between the outer faces"});
  keys.push_back({"roof", "span", K::number, "m", 0.1, 1000, "3", "", "across the ridge, between the outer faces of the walls that it lies on"});
  keys.push_back({"roof", "pitch_degrees", K::number, "degrees", 1, 70, "20", "", "steeper than its friction holds (wood: 24) it wants nails"});
  keys.push_back({"roof", "overhang", K::number, "m", 0, 10, "0.15", "", "beyond the walls, on all sides"});
  keys.push_back({"roof", "trusses", K::integer, "", 2, 1000, "4", "", "triangles of two rafters and a tie beam, that lie on the walls"});
  keys.push_back({"roof", "inset", K::number, "m", 0, 1000, "0.3", "", "of the first and the last truss from the ends of `length`"});
  keys.push_back({"roof", "timber", K::pair, "m", kSmall, 10, "[0.05, 0.1]", "", "width and height of rafters and beams"});
  keys.push_back({"roof", "boards", K::integer, "", 1, 1000, "8", "", "on each side, along the ridge"});
  keys.push_back({"roof", "board_thickness", K::number, "m", kSmall, 10, "0.025", "", "of a board"});
  keys.push_back({"roof", "nail_force", K::number, "N", 0, 1e12, "0", "", "each board is nailed to each truss, and comes off under more; 0: no nails"});
  keys.push_back({"roof", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "middle of its foot, on top of the walls"});
  keys.push_back({"roof", "yaw_degrees", K::number, "degrees", -3600, 3600, "0", "", "about the vertical; 0: the ridge runs along x"});
  keys.push_back({"roof", "material", K::material, "", 0, 0, "\"wood\"", "", "of boards and timber"});
  keys.push_back({"roof", "colour", K::colour, "", 0, 0, "-", "", "of boards and timber; default: the material's"});
}

void addBodyKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"body", "name", K::name, "", 0, 0, "-", "", "its name in reports and in the replay"});
  keys.push_back({"body", "type", K::choice, "", 0, 0, "\"dynamic\"", "fixed|kinematic|dynamic", "never moves, moves as told, moves by forces"});
  addShape(keys, "body");
  keys.push_back({"body", "part", K::tables, "", 0, 0, "-", "", "several shapes in one body, instead of `shape`"});
  keys.push_back({"body", "material", K::material, "", 0, 0, "\"brick\"", "", "of all shapes that name no other"});
  keys.push_back({"body", "colour", K::colour, "", 0, 0, "-", "", "of the whole body; default: the material's"});
  keys.push_back({"body", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "origin of the body: the middle of a shape"});
  keys.push_back({"body", "rotation_degrees", K::vector, "degrees", -3600, 3600, "[0, 0, 0]", "", "about the world's x, then y, then z axis"});
  addMotion(keys, "body");
  keys.push_back({"body", "surface_velocity", K::vector, "m/s", -kFast, kFast, "[0, 0, 0]", "", "fixed, kinematic: its surface runs so in the body's own axes, as a conveyor's does"});
  addLaunch(keys, "body");
  keys.push_back({"body", "interpolation", K::choice, "", 0, 0, "\"smooth\"", "smooth|linear", "between keys: without a jerk, or straight"});
  keys.push_back({"body", "key", K::tables, "", 0, 0, "-", "", "kinematic: poses that it passes through"});
}

void addPartKeys(std::vector<KeySpec>& keys) {
  addShape(keys, "body.part");
  keys.push_back({"body.part", "material", K::material, "", 0, 0, "-", "", "of this part; default: the body's"});
  keys.push_back({"body.part", "position", K::vector, "m", -kLarge, kLarge, "[0, 0, 0]", "", "in the body's frame"});
  keys.push_back({"body.part", "rotation_degrees", K::vector, "degrees", -3600, 3600, "[0, 0, 0]", "", "in the body's frame"});
}

void addBodyKeyKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"body.key", "time", K::number, "s", 0, kLate, "", "", "later than that of the key before"});
  keys.push_back({"body.key", "position", K::vector, "m", -kFar, kFar, "-", "", "where it then is; default: as before"});
  keys.push_back({"body.key", "rotation_degrees", K::vector, "degrees", -3600, 3600, "-", "", "how it then lies; default: as before"});
}

void addBallKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"ball", "name", K::name, "", 0, 0, "-", "", "its name in reports and in the replay"});
  keys.push_back({"ball", "radius", K::number, "m", kSmall, kLarge, "0.1", "", "of the ball"});
  keys.push_back({"ball", "material", K::material, "", 0, 0, "\"steel\"", "", "of the ball"});
  keys.push_back({"ball", "colour", K::colour, "", 0, 0, "-", "", "of the ball; default: the material's"});
  keys.push_back({"ball", "density", K::number, "kg/m3", scene_limits::kSmallestDensity, scene_limits::kLargestDensity, "-", "", "instead of the material's"});
  keys.push_back({"ball", "friction", K::number, "", 0, 100, "-", "", "instead of the material's"});
  keys.push_back({"ball", "restitution", K::number, "", 0, 1, "-", "", "instead of the material's"});
  keys.push_back({"ball", "rolling_resistance", K::number, "", 0, limits::kLargestFriction, "-", "", "instead of the material's"});
  keys.push_back({"ball", "position", K::vector, "m", -kFar, kFar, "", "", "of its centre"});
  addMotion(keys, "ball");
  addLaunch(keys, "ball");
}

void addArrayKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"array", "name", K::name, "", 0, 0, "-", "", "bodies are called name/0, name/1, ..."});
  keys.push_back({"array", "arrangement", K::choice, "", 0, 0, "\"lattice\"", "lattice|pyramid", "rows, columns and layers, or rows that each have one less"});
  keys.push_back({"array", "count", K::counts, "", 1, 10000, "[1, 1, 1]", "", "lattice: bodies along x, y, z"});
  keys.push_back({"array", "base", K::integer, "", 1, 10000, "10", "", "pyramid: bodies in the lowest row, along x"});
  keys.push_back({"array", "spacing", K::positive, "m", 0.0001, kLarge, "-", "", "between centres; default: they touch"});
  keys.push_back({"array", "jitter", K::number, "m", 0, 100, "0", "", "random shift of each body, up to this on each axis"});
  addShape(keys, "array");
  keys.push_back({"array", "size_min", K::positive, "m", kSmall, kLarge, "-", "", "box: random lengths from this to `size`"});
  keys.push_back({"array", "type", K::choice, "", 0, 0, "\"dynamic\"", "fixed|kinematic|dynamic", "never move, move as told, move by forces; of meshes fixed or kinematic"});
  keys.push_back({"array", "material", K::material, "", 0, 0, "\"brick\"", "", "of all bodies"});
  keys.push_back({"array", "colour", K::colour, "", 0, 0, "-", "", "of all bodies; default: the material's"});
  keys.push_back({"array", "yaw_degrees", K::number, "degrees", -3600, 3600, "0", "", "about the vertical through `position`"});
  keys.push_back({"array", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "middle of the lowest layer's underside"});
  addMotion(keys, "array");
}

void addArchKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"arch", "name", K::name, "", 0, 0, "-", "", "stones are called name/0, name/1, ..."});
  keys.push_back({"arch", "stones", K::integer, "", 2, 1000, "21", "", "how many"});
  keys.push_back({"arch", "radius", K::number, "m", kSmall, kLarge, "1", "", "of the line through the middle of the stones"});
  keys.push_back({"arch", "thickness", K::number, "m", kSmall, kLarge, "0.2", "", "along the radius"});
  keys.push_back({"arch", "block", K::pair, "m", kSmall, kLarge, "-", "", "width and height (from the centre up) of a block that its stones fill: of an opening of a wall"});
  keys.push_back({"arch", "depth", K::number, "m", kSmall, kLarge, "0.3", "", "along the arch's axis (z)"});
  keys.push_back({"arch", "angle_degrees", K::number, "degrees", 1, 180, "180", "", "that it spans; 180: half a circle, its feet flat"});
  keys.push_back({"arch", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "the circle's centre"});
  keys.push_back({"arch", "yaw_degrees", K::number, "degrees", -3600, 3600, "0", "", "about the vertical; 0: it spans along x"});
  keys.push_back({"arch", "material", K::material, "", 0, 0, "\"brick\"", "", "of the stones"});
  keys.push_back({"arch", "colour", K::colour, "", 0, 0, "-", "", "of the stones; default: the material's"});
  keys.push_back({"arch", "mortar", K::mortar, "", 0, 0, "\"none\"", "", "between the stones: a kind of mortar, \"none\", or [arch.mortar]"});
  keys.push_back({"arch", "foot", K::boolean, "", 0, 0, "false", "", "with mortar: its feet are mortared to what they stand on"});
}

void addMortarKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"mortar", "body_a", K::name, "", 0, 0, "", "", "one body"});
  keys.push_back({"mortar", "body_b", K::name, "", 0, 0, "-", "", "the other; default: all that lie face to face with it"});
  keys.push_back({"mortar", "gap", K::number, "m", 0, 1, "0.001", "", "faces further apart are not joined"});
  addOwnMortarKeys(keys, "mortar");
}

void addDomeKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"dome", "name", K::name, "", 0, 0, "-", "", "stones are called name/ring/0, ..., those of the drum name/drum/ring/0, ..."});
  keys.push_back({"dome", "rings", K::integer, "", 1, 100, "8", "", "of stones, from the springing to the crown"});
  keys.push_back({"dome", "stones", K::integer, "", 3, 32, "16", "", "of each ring; their upright joints stand above each other"});
  keys.push_back({"dome", "radius", K::number, "m", kSmall, kLarge, "1", "", "of the surface through the middle of the stones"});
  keys.push_back({"dome", "thickness", K::number, "m", kSmall, kLarge, "0.15", "", "along the radius"});
  keys.push_back({"dome", "angle_degrees", K::number, "degrees", 1, 90, "90", "", "from the crown to the springing; 90: half a sphere"});
  keys.push_back({"dome", "oculus_degrees", K::number, "degrees", 0, 89, "0", "", "from the crown to the edge of a round opening; 0: a keystone closes it"});
  keys.push_back({"dome", "drum_rings", K::integer, "", 0, 100, "0", "", "of stones in the round wall under it"});
  keys.push_back({"dome", "drum_height", K::number, "m", kSmall, kLarge, "0.5", "", "of that wall"});
  keys.push_back({"dome", "drum_thickness", K::number, "m", kSmall, kLarge, "-", "", "of that wall, its middle under that of the dome's foot; default: that of the dome"});
  keys.push_back({"dome", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "middle of the foot, that of the drum if it has one"});
  keys.push_back({"dome", "yaw_degrees", K::number, "degrees", -3600, 3600, "0", "", "about the vertical"});
  keys.push_back({"dome", "material", K::material, "", 0, 0, "\"brick\"", "", "of the stones"});
  keys.push_back({"dome", "colour", K::colour, "", 0, 0, "-", "", "of the stones; default: the material's"});
}

void addJointKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"joint", "name", K::name, "", 0, 0, "-", "", "its name"});
  keys.push_back({"joint", "type", K::choice, "", 0, 0, "\"spherical\"", "spherical|fixed|revolute|prismatic|distance|rope|spring", "what it holds"});
  keys.push_back({"joint", "body_a", K::name, "", 0, 0, "-", "", "one body, or a wall, an arch, ...: its body nearest to `anchor`; default: the ground"});
  keys.push_back({"joint", "body_b", K::name, "", 0, 0, "", "", "the other, in the same way"});
  keys.push_back({"joint", "anchor", K::vector, "m", -kFar, kFar, "", "", "point where it holds; of distance, rope and spring: the point of body_a"});
  keys.push_back({"joint", "anchor_b", K::vector, "m", -kFar, kFar, "-", "", "distance, rope, spring: the point of body_b; default: `anchor`"});
  keys.push_back({"joint", "axis", K::vector, "", -1000, 1000, "[0, 1, 0]", "", "spherical (of the twist), revolute, prismatic"});
  keys.push_back({"joint", "lower_degrees", K::number, "degrees", -180, 0, "-", "", "spherical, revolute: least turn of body_b about the axis"});
  keys.push_back({"joint", "upper_degrees", K::number, "degrees", 0, 180, "-", "", "most turn; both or none"});
  keys.push_back({"joint", "lower", K::number, "m", -kLarge, 0, "-", "", "prismatic: least way of body_b along the axis"});
  keys.push_back({"joint", "upper", K::number, "m", 0, kLarge, "-", "", "most way; both or none"});
  keys.push_back({"joint", "cone_degrees", K::number, "degrees", 0.6, 171, "-", "", "spherical: the axes of both stay within this angle"});
  keys.push_back({"joint", "motor_speed", K::number, "rad/s, m/s", -kFast, kFast, "-", "", "revolute, prismatic: what a motor drives it at"});
  keys.push_back({"joint", "motor_strength", K::number, "N m, N", 0, 1e12, "-", "", "the most that the motor gives"});
  keys.push_back({"joint", "length", K::number, "m", limits::kSmallestSize, limits::kLargestSize, "-", "", "distance, rope, spring; default: as far as the anchors are apart"});
  keys.push_back({"joint", "stiffness", K::number, "N/m", 0, 1e12, "1000", "", "spring"});
  keys.push_back({"joint", "damping", K::number, "N s/m", 0, 1e12, "0", "", "spring"});
  keys.push_back({"joint", "break_force", K::number, "N", 1e-6, 1e12, "-", "", "it breaks under more, as a mean over 1/60 s; default: never"});
  keys.push_back({"joint", "break_torque", K::number, "N m", 1e-6, 1e12, "-", "", "the same"});
  keys.push_back({"joint", "collide", K::boolean, "", 0, 0, "false", "", "its two bodies may touch each other"});
}

void addChainKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"chain", "name", K::name, "", 0, 0, "-", "", "links are called name/0, name/1, ..., joints name.0, name.1, ..."});
  keys.push_back({"chain", "body_a", K::name, "", 0, 0, "-", "", "what its first link hangs on, as in [[joint]]; default: the ground"});
  keys.push_back({"chain", "body_b", K::name, "", 0, 0, "-", "", "what hangs on its last; default: nothing"});
  keys.push_back({"chain", "from", K::vector, "m", -kFar, kFar, "", "", "where it begins"});
  keys.push_back({"chain", "to", K::vector, "m", -kFar, kFar, "", "", "where it ends"});
  keys.push_back({"chain", "links", K::integer, "", 1, 10000, "10", "", "how many"});
  keys.push_back({"chain", "link", K::choice, "", 0, 0, "\"rod\"", "rod|board", "rods with round ends, or boards"});
  keys.push_back({"chain", "radius", K::number, "m", kSmall, kLarge, "0.02", "", "of a rod"});
  keys.push_back({"chain", "thickness", K::number, "m", kSmall, kLarge, "0.05", "", "of a board"});
  keys.push_back({"chain", "width", K::number, "m", kSmall, kLarge, "0.5", "", "of a board"});
  keys.push_back({"chain", "sag", K::number, "m", 0, kLarge, "0", "", "so much lower is its middle at the start"});
  keys.push_back({"chain", "hinge_axis", K::vector, "", -1000, 1000, "-", "", "joints are hinges about it; default: ball joints"});
  keys.push_back({"chain", "hinge_friction", K::number, "N m", 0, 1e12, "0", "", "of each hinge: it holds up to this torque, then rubs with it"});
  keys.push_back({"chain", "material", K::material, "", 0, 0, "\"steel\"", "", "of the links"});
  keys.push_back({"chain", "break_force", K::number, "N", 1e-6, 1e12, "-", "", "of each joint, as that of [[joint]]"});
  keys.push_back({"chain", "break_torque", K::number, "N m", 1e-6, 1e12, "-", "", "the same"});
}

void addTiltKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"tilt", "body", K::name, "", 0, 0, "-", "", "a kinematic body; default: everything, by turning gravity"});
  keys.push_back({"tilt", "axis", K::vector, "", -1000, 1000, "[0, 0, 1]", "", "direction of the axis"});
  keys.push_back({"tilt", "pivot", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "a point of the axis"});
  keys.push_back({"tilt", "from", K::number, "s", 0, kLate, "0", "", "when it begins, with `rate_degrees`"});
  keys.push_back({"tilt", "rate_degrees", K::number, "degrees/s", 1e-6, 3600, "-", "", "how fast it turns"});
  keys.push_back({"tilt", "to_degrees", K::number, "degrees", -3600, 3600, "-", "", "how far it turns"});
  keys.push_back({"tilt", "interpolation", K::choice, "", 0, 0, "\"smooth\"", "smooth|linear", "between keys: without a jerk, or straight"});
  keys.push_back({"tilt", "key", K::tables, "", 0, 0, "-", "", "angles that it passes through, instead of a rate"});
  keys.push_back({"tilt.key", "time", K::number, "s", 0, kLate, "", "", "later than that of the key before"});
  keys.push_back({"tilt.key", "degrees", K::number, "degrees", -3600, 3600, "", "", "how far it then is turned"});
}

void addShakeKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"shake", "body", K::name, "", 0, 0, "-", "", "a kinematic body; default: everything, as seen from the ground"});
  keys.push_back({"shake", "direction", K::vector, "", -1000, 1000, "[1, 0, 0]", "", "of the accelerations"});
  keys.push_back({"shake", "from", K::number, "s", 0, kLate, "0", "", "when it begins"});
  keys.push_back({"shake", "signal", K::choice, "", 0, 0, "\"sine\"", "record|sine|full_pulse|half_pulse|square_pulse", "a file, a sine that grows and dies away, or one pulse"});
  keys.push_back({"shake", "amplitude", K::number, "m/s2", -1000, 1000, "1", "", "sine and pulses: the largest acceleration"});
  keys.push_back({"shake", "frequency", K::number, "1/s", 0.01, 100, "1", "", "sine"});
  keys.push_back({"shake", "seconds", K::number, "s", 0.001, kLate, "1", "", "sine and pulses: how long"});
  keys.push_back({"shake", "ramp", K::number, "s", 0.001, kLate, "-", "", "sine: so long it grows, and so long it dies away; default: a period, at most half of `seconds`"});
  keys.push_back({"shake", "file", K::text, "", 1, 1000, "-", "", "record: a .csv file, relative to the scene file"});
  keys.push_back({"shake", "unit", K::choice, "", 0, 0, "-", "m/s2|cm/s2|mm/s2|g", "record: of its accelerations; must be given (g = 9.80665 m/s2)"});
  keys.push_back({"shake", "time_unit", K::choice, "", 0, 0, "\"s\"", "s|ms", "record: of its times"});
  keys.push_back({"shake", "column", K::integer, "", 1, 1000, "1", "", "record: that is read, the one after the time is 1"});
  keys.push_back({"shake", "scale", K::number, "", -1000, 1000, "1", "", "record: factor of its accelerations"});
  keys.push_back({"shake", "baseline", K::choice, "", 0, 0, "\"rest\"", "rest|none", "record: ends at rest where it began, by a straight line taken from it; or as its sums have it"});
}

void addAirKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"wind", "velocity", K::vector, "m/s", -1000, 1000, "", "", "of the air"});
  keys.push_back({"wind", "from", K::number, "s", 0, kLate, "0", "", "when it begins"});
  keys.push_back({"wind", "until", K::number, "s", 0, kLate, "-", "", "when it is over; default: never"});
  keys.push_back({"wind", "ramp", K::number, "s", 0, kLate, "0", "", "so long it grows, and so long it dies away"});
  keys.push_back({"wind", "drag_coefficient", K::number, "", 0, 100, "1.3", "", "of a plate across the wind: 8/13 press on it, 5/13 draw"});
  keys.push_back({"wind", "shelter", K::boolean, "", 0, 0, "true", "", "what stands before a face keeps the wind from it"});
  keys.push_back({"blast", "centre", K::vector, "m", -kFar, kFar, "", "", "where it spreads from"});
  keys.push_back({"blast", "impulse", K::number, "N s", 0, 1e9, "", "", "over all directions together; the share of a face is its solid angle"});
  keys.push_back({"blast", "radius", K::number, "m", 0.001, 10000, "", "", "no face beyond feels it"});
  keys.push_back({"blast", "time", K::number, "s", 0, kLate, "0", "", "when it goes off"});
  keys.push_back({"blast", "occlusion", K::boolean, "", 0, 0, "true", "", "what is hidden from the centre feels nothing"});
}

void addCameraKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"camera", "name", K::name, "", 0, 0, "\"main\"", "", "its name in the replay"});
  keys.push_back({"camera", "position", K::vector, "m", -kFar, kFar, "[3, 2, 5]", "", "where it stands"});
  keys.push_back({"camera", "target", K::vector, "m", -kFar, kFar, "[0, 0.5, 0]", "", "what it looks at"});
  keys.push_back({"camera", "look_at", K::name, "", 0, 0, "-", "", "instead of `target`: a body, a wall, a group, ..., at its middle at the start"});
  keys.push_back({"camera", "follow", K::boolean, "", 0, 0, "false", "", "whether it turns after the body that `look_at` names, all the while"});
  keys.push_back({"camera", "field_of_view_degrees", K::number, "degrees", 1, 170, "45", "", "vertical"});
  keys.push_back({"camera", "key", K::tables, "", 0, 0, "-", "", "poses that it passes through in a film (brickfall render)"});
}

void addCameraKeyKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"camera.key", "time", K::number, "s", 0, 86400, "", "", "simulated; later than the key before"});
  keys.push_back({"camera.key", "position", K::vector, "m", -kFar, kFar, "-", "", "where it then stands; default: the camera's position"});
  keys.push_back({"camera.key", "target", K::vector, "m", -kFar, kFar, "-", "", "what it then looks at; default: the camera's target"});
  keys.push_back({"camera.key", "field_of_view_degrees", K::number, "degrees", 1, 170, "-", "", "vertical; default: the camera's"});
}

constexpr const char* kInGroups[] = {"wall", "pier", "roof", "body", "ball", "array", "arch", "dome", "mortar", "joint", "chain", "tilt", "shake", "blast", "camera", "copy"};

void addGroupKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"group", "name", K::name, "", 0, 0, "", "", "what copies call it; what is in it is called name/..."});
  keys.push_back({"group", "position", K::vector, "m", -kFar, kFar, "[0, 0, 0]", "", "where its origin stands: its tables are placed from there"});
  keys.push_back({"group", "yaw_degrees", K::number, "degrees", -3600, 3600, "0", "", "about the vertical through its origin"});
  keys.push_back({"group", "template", K::boolean, "", 0, 0, "false", "", "true: it only is there to be copied"});
  for (const char* table : kInGroups) keys.push_back({"group", table, K::tables, "", 0, 0, "-", "", "as at the top level, in the group's own frame"});
}

void addCopyKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"copy", "of", K::name, "", 0, 0, "", "", "the name of a group, a wall, a body, ..."});
  keys.push_back({"copy", "name", K::name, "", 0, 0, "-", "", "its own; default: the other's, with \" copy\" behind it"});
  keys.push_back({"copy", "position", K::vector, "m", -kFar, kFar, "-", "", "where it stands; default: where the other does"});
  keys.push_back({"copy", "yaw_degrees", K::number, "degrees", -3600, 3600, "-", "", "how it is turned; default: as the other"});
}

void addRepetitionKeys(std::vector<KeySpec>& keys) {
  keys.push_back({"repeat", "count", K::integer, "", 0, 100000, "-", "", "how many"});
  keys.push_back({"repeat", "grid", K::counts, "", 0, 10000, "-", "", "instead: how many along x, y and z"});
  keys.push_back({"repeat", "step", K::vector, "m", -kFar, kFar, "-", "", "from one to the next; of a grid along each axis"});
  keys.push_back({"repeat", "about", K::vector, "m", -kFar, kFar, "-", "", "middle of a ring: each is turned about the vertical through it"});
  keys.push_back({"repeat", "turn_degrees", K::number, "degrees", -3600, 3600, "-", "", "from one of a ring to the next; default: all the way round"});
  keys.push_back({"repeat", "index", K::name, "", 0, 0, "\"i\"", "", "what its number is called in expressions and names: $i is 0, 1, ..."});
}

// Every table that there may be several of can be repeated. `repeat` and `let` are gone once the file is read.
void addRepeatKeys(std::vector<KeySpec>& keys) {
  std::vector<const char*> tables;
  for (const KeySpec& spec : keys) {
    const std::string_view table = spec.table;
    const std::size_t dot = table.find('.');
    const std::string_view owner = dot == table.npos ? std::string_view() : table.substr(0, dot);
    const std::string_view own = dot == table.npos ? table : table.substr(dot + 1);
    bool several = false;
    for (const KeySpec& other : keys) several = several || (other.kind == K::tables && other.table == owner && other.key == own);
    if (several && !table.empty() && (tables.empty() || std::string_view(tables.back()) != table)) tables.push_back(spec.table);
  }
  for (const char* table : tables) {
    keys.push_back({table, "repeat", K::repeat, "", 0, 100000, "-", "", "how many of it: a number, or [repeat] with more"});
    keys.push_back({table, "let", K::parameters, "", 0, 0, "-", "", "named numbers for this table alone, of each repetition anew"});
  }
}

std::vector<KeySpec> makeKeys() {
  std::vector<KeySpec> keys;
  addSceneKeys(keys);
  addWorldKeys(keys);
  addSolverKeys(keys);
  addReportKeys(keys);
  addGroundKeys(keys);
  addMaterialKeys(keys);
  addBrickKindKeys(keys);
  addMortarKindKeys(keys);
  addWallKeys(keys);
  addOwnMortarKeys(keys, "wall.mortar");
  addOpeningKeys(keys);
  addPierKeys(keys);
  addRoofKeys(keys);
  addBodyKeys(keys);
  addPartKeys(keys);
  addBodyKeyKeys(keys);
  addBallKeys(keys);
  addArrayKeys(keys);
  addArchKeys(keys);
  addOwnMortarKeys(keys, "arch.mortar");
  addMortarKeys(keys);
  addDomeKeys(keys);
  addJointKeys(keys);
  addChainKeys(keys);
  addTiltKeys(keys);
  addShakeKeys(keys);
  addAirKeys(keys);
  addCameraKeys(keys);
  addCameraKeyKeys(keys);
  addGroupKeys(keys);
  addCopyKeys(keys);
  addRepetitionKeys(keys);
  addRepeatKeys(keys);
  return keys;
}
// clang-format on

}  // namespace

const std::vector<KeySpec>& keySpecs() {
  static const std::vector<KeySpec> keys = makeKeys();
  return keys;
}

const KeySpec* findKey(std::string_view table, std::string_view key) {
  using Keys = std::map<std::string_view, const KeySpec*>;
  static const auto tables = [] {
    std::map<std::string_view, Keys> all;
    for (const KeySpec& spec : keySpecs()) all[spec.table].emplace(spec.key, &spec);
    return all;
  }();
  const auto known = tables.find(table);
  if (known == tables.end()) return nullptr;
  const auto found = known->second.find(key);
  return found == known->second.end() ? nullptr : found->second;
}

Frame frameOf(const KeySpec& spec) {
  const std::string_view key = spec.key;
  if (key == "yaw_degrees") return Frame::yaw;
  if (spec.kind != K::vector) return Frame::none;
  for (const char* point : {"position", "target", "anchor", "anchor_b", "pivot", "centre", "from", "to"})
    if (key == point) return Frame::point;
  for (const char* direction : {"velocity", "angular_velocity", "axis", "hinge_axis", "direction"})
    if (key == direction) return Frame::direction;
  return Frame::none;
}

std::string meantTable(std::string_view thing) {
  static constexpr std::pair<std::string_view, const char*> kThings[] = {
      {"sphere", "ball"},  {"box", "body"},      {"brick", "wall"},   {"column", "array"},    {"tower", "wall"},
      {"pile", "array"},   {"pyramid", "array"}, {"cube", "body"},    {"beam", "body"},       {"slab", "body"},
      {"hinge", "joint"},  {"rope", "joint"},    {"spring", "joint"}, {"explosion", "blast"}, {"view", "camera"},
      {"floor", "ground"}, {"plane", "ground"},  {"ring", "wall"},    {"corner", "wall"},     {"gate", "wall"},
      {"vault", "arch"},   {"storey", "group"},  {"quake", "shake"},  {"earthquake", "shake"}};
  std::string word(thing);
  if (word.ends_with('s')) word.pop_back();
  for (const auto& [name, table] : kThings)
    if (name == thing || name == word) return table;
  return {};
}

std::vector<std::string> keysOf(std::string_view table) {
  std::vector<std::string> out;
  for (const KeySpec& spec : keySpecs())
    if (spec.table == table) out.push_back(spec.key);
  return out;
}

std::string tableTitle(std::string_view table) {
  if (table.empty()) return "the top level";
  for (const KeySpec& spec : keySpecs()) {
    std::string full = *spec.table ? std::string(spec.table) + "." + spec.key : std::string(spec.key);
    if (full == table) return spec.kind == K::tables ? "[[" + full + "]]" : "[" + full + "]";
  }
  return std::string(table);
}

std::string ownerOfKey(std::string_view key) {
  for (const KeySpec& spec : keySpecs())
    if (spec.key == key) return tableTitle(spec.table);
  return {};
}

std::vector<std::string> choicesOf(const KeySpec& spec) {
  std::vector<std::string> out;
  std::string_view rest = spec.choices;
  while (!rest.empty()) {
    std::size_t bar = std::min(rest.find('|'), rest.size());
    out.emplace_back(rest.substr(0, bar));
    rest.remove_prefix(std::min(bar + 1, rest.size()));
  }
  return out;
}

std::string expectation(const KeySpec& spec) {
  std::string range = numberText(spec.minimum) + " .. " + numberText(spec.maximum);
  std::string unit = *spec.unit ? std::string(" ") + spec.unit : std::string();
  std::string list;
  std::vector<std::string> choices = choicesOf(spec);
  for (std::size_t i = 0; i < choices.size(); i++)
    list += (i == 0 ? "\"" : i + 1 == choices.size() ? " or \"" : ", \"") + choices[i] + "\"";
  switch (spec.kind) {
    case K::number:
      return "a number " + range + unit;
    case K::integer:
      return "a whole number " + range;
    case K::boolean:
      return "true or false";
    case K::text:
      return "a text of at most " + numberText(spec.maximum) + " characters";
    case K::name:
      return "a text of 1 .. 64 characters";
    case K::choice:
      return list;
    case K::material:
      return "the name of a material";
    case K::mortarKind:
      return "the name of a kind of mortar";
    case K::mortar:
      return std::string("the name of a kind of mortar, \"none\", or a table: write [") + spec.table + "." + spec.key +
             "]";
    case K::colour:
      return "a colour as \"#RRGGBB\"";
    case K::vector:
    case K::positive:
      return "three numbers [x, y, z], each " + range + unit;
    case K::counts:
      return "three whole numbers [x, y, z], each " + range;
    case K::gravity:
      return "a number or three numbers [x, y, z], each " + range + unit;
    case K::brick:
      return "the name of a kind of brick, or [length, height, width], each " + range + unit;
    case K::pair:
      return "two numbers [a, b], each " + range + unit;
    case K::wholePair:
      return "two whole numbers [a, b], each " + range;
    case K::points:
      return "4 .. 64 points [[x, y, z], ...], each coordinate " + range + unit;
    case K::times:
      return "1 .. 1000 times [t, ...], each " + range + unit + ", that ascend";
    case K::numbers:
      return "whole numbers [a, ...], each " + range + ", that ascend";
    case K::planPoints:
      return "2 .. 1000 points [[x, z], ...], each coordinate " + range + unit;
    case K::texts:
      return "a text, or several: [\"a\", \"b\"]";
    case K::repeat:
      return "how often, a whole number " + range + ", or a table: write [" + std::string(spec.table) + ".repeat]";
    case K::parameters:
      return "a table of numbers";
    case K::table:
      return std::string("a table: write [") + spec.key + "]";
    case K::tables:
      break;
  }
  std::string full = *spec.table ? std::string(spec.table) + "." + spec.key : std::string(spec.key);
  return "an array of tables: write [[" + full + "]]";
}

}  // namespace brickfall::scene
