// Walls of bricks: from a bond, a length and a height to the place of every brick. Knows no World.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "brickfall/math.h"
#include "brickfall/result.h"
#include "brickfall/shapes.h"

namespace brickfall {

// running: each course shifted by half a brick (or bondShift of one); header: all headers; english: courses of stretchers
// and headers in turn; flemish: stretchers and headers in turn in each course; stack: joints above each other.
enum class Bond : std::uint8_t { running, header, english, flemish, stack };

// A hollow in a brick's upper face, with flat sides that lean inwards.
struct Frog {
  double length = 0, width = 0;            // m, at the face
  double floorLength = 0, floorWidth = 0;  // m, at its floor
  double depth = 0;                        // m; 0: none
};

// Round holes from bed face to bed face, evenly spaced over a brick.
struct Perforation {
  int along = 0, across = 0;  // 0: none
  double radius = 0;          // m
};

struct BrickFormat {
  Vec3 size{0.215, 0.065, 0.1025};  // m: length (along the wall), height, width (through the wall)
  Frog frog;                        // not both
  Perforation holes;
};

// How a brick's density differs from its mean: by a random linear field and by random noise in 4 x 2 x 2 equal parts of it.
struct UnevenDensity {
  double gradient = 0;  // 0 .. 0.2: along each axis, up to so much from the middle to a face
  double noise = 0;     // 0 .. 0.2: up to so much in each part
};

// A rectangular hole in the wall; bricks that reach into it are cut or left out. A lintel carries what is above.
struct Opening {
  double from = 0;              // m along the wall from its left end
  double sill = 0;              // m above the foot (0 = door)
  double width = 1;             // m
  double height = 1;            // m
  double lintelBearing = 0.15;  // m that the lintel reaches into the wall on either side
  double lintelHeight = 0.065;  // m; 0 = none
};

// A pier bonded into a wall: a block of bricks, in every second course crosswise with the wall against it, in the others along with
// the wall going through.
struct Pier {
  double at = 0;       // m along the wall: its middle; it ends with the wall at its ends
  double width = 1.5;  // brick lengths along the wall, in halves, >= 1
  double depth = 1.5;  // brick lengths through it, in halves: more than the wall
  int higher = 0;      // courses above those of the wall
};

// Where another wall goes into this one, in every second course.
struct LetIn {
  int side = 0;             // of the path
  double from = 0, to = 0;  // m along it
  int firstCourse = 0, endCourse = 0;
  int parity = 1;  // the courses that are odd, or even
};

struct WallDef {
  std::string name = "wall";
  Bond bond = Bond::running;
  double bondShift = 0.5;  // running bond: shift of every second course, in brick lengths (0.5 half, 0.333 third bond)
  BrickFormat brick;
  int courses = 10;          // 1 .. 10000
  int bricksPerCourse = 10;  // whole bricks (header bond: headers) in a full course, 1 .. 10000; sets the length
  bool halfBats = true;      // ends closed by cut bricks, flush; false: whole bricks only, toothed ends
  double headJoint = 0;      // m, gap between neighbours in a course
  double bedJoint = 0;       // m, gap between courses
  Vec3 position;             // m: left end of the foot, middle of the thickness
  double yawDegrees = 0;     // about +y; 0: the wall runs along +x
  std::vector<Opening> openings;
  // Not straight: along a path in plan, or on a circle. Then its length is theirs, and its bricks those that fit.
  std::vector<Vec3> path;  // m, corners of its middle line, y 0, from `position`; corners are bonded
  bool closed = false;     // the last corner is joined to the first
  double radius = 0;       // m, of its middle line about `position`; 0: none. It begins at +z and runs towards +x
  double arcDegrees = 360;
  double gableDegrees = 0;      // slope of a gable on top; 0: none
  std::vector<int> gableSides;  // of a path, from 0; empty: all
  std::vector<Pier> piers;      // on a round wall straight blocks; on a path between its corners
  bool pierAlone = false;       // no wall: one pier, its middle at `position`
  std::vector<LetIn> letIn;
  // m that it reaches beyond its ends in even and in odd courses, where it goes into another wall; less than 0: short of it.
  double startReach[2] = {0, 0}, endReach[2] = {0, 0};
  double disorder = 0;   // m, >= 0: every brick out of true by random gaps below it of 0 .. this and like shifts
  bool shuffle = false;  // bricks are created in random order (the result must not depend on it)
};

struct BrickPlacement {
  std::string name;  // "wall/3/7": wall, course from 0, position in the course
  Vec3 centre;       // m, world
  Quat rotation;
  Vec3 size;  // m: along the wall, height, through the wall
  int course = 0;
  bool cut = false;  // half bat, closer or cut at an opening
  bool lintel = false;
  // rad: a lintel of a round wall turns by so much from end to end, about a vertical behind it (-z); size.x is along its middle.
  double bend = 0;
};
// In its own axes: a box; of a lintel that is bent several wedges, each straight to within a tenth of its thickness.
std::vector<ShapeDef> shapesOf(const BrickPlacement& brick);

// What is wrong with a wall: the field ("courses", "openings[1].from"), what was found and what was expected.
struct WallProblem {
  std::string field;
  std::string message;
};
// All of it; empty = layBricks will succeed.
std::vector<WallProblem> checkWall(const WallDef& wall);
// m: of a full course, and through the wall (one brick length for header, English and Flemish bond).
double wallLength(const WallDef& wall);
double wallThickness(const WallDef& wall);
// Bricks of the wall if it had no openings.
std::int64_t brickCount(const WallDef& wall);

// The bricks of a wall, lowest course first. Errors name the field of the wall.
Result<std::vector<BrickPlacement>> layBricks(const WallDef& wall, std::uint64_t seed);

// What a brick of the wall is made of, at a mean density of 1 kg/m3, about the middle of the placement, in its axes. Its mass is the
// volume of what is there. A cut brick has the hollows of a whole one, narrowed with it; lintels are solid. Exact for solid and
// hollow bricks, and for mass and centre of a solid one of uneven density. Hollows of an uneven brick are taken out at the density of
// the linear field in their middle: with one of 0.05 and noise of 0.05 that is within 0.2 % of the mass.
MassProperties brickMass(const WallDef& wall, const BrickPlacement& brick, const UnevenDensity& uneven = {},
                         std::uint64_t seed = 0);
// The same in kg, with the mortar that fills its frog and makes it a grown brick; about the middle of the grown brick.
struct GrownBrick;
MassProperties mortaredBrickMass(const WallDef& wall, const BrickPlacement& brick, const GrownBrick& grown,
                                 const MassProperties& atOne, double brickDensity, double mortarDensity);

// --- Mortar. Its layer fills the gaps between bricks. In a world each brick is grown to the middle of its layers, so that what
// is broken does not fall by a layer; a joint's face is that on which the bricks themselves lie opposite each other.

// m: the widest gaps of a wall that are joints, between faces that stand and faces that lie. Wider than headJoint in thick
// bonds, where headers or leaves are further apart.
struct JointWidths {
  double head = 0, bed = 0;
  double wedge =
      0;  // rad: of a round wall, faces that stand and are turned by up to this from each other are joined as well
};
JointWidths jointWidths(const WallDef& wall);

// The bricks of a wall that is laid in mortar.
struct MortaredBricks {
  std::span<const BrickPlacement> bricks;
  JointWidths widths;
};

struct MortarJoint {
  std::size_t a = 0, b = 0;   // bricks, counted through all walls; a < b
  std::vector<Vec3> outline;  // m, world: in the middle of the layer, anticlockwise as seen from b
  bool bed = false;           // its faces lie; else they stand: head joints, between leaves, at corners
  double thickness = 0;       // m, of the layer
};

// A brick with its half of the layers around it.
struct GrownBrick {
  Vec3 centre;  // m, world; turned as the brick
  Vec3 size;    // m
};

// A layer of mortar as it is drawn with one of the two bricks: it stays there when the joint breaks. On the lower brick, and upright on
// the one that comes first.
struct MortarSlab {
  Vec3 centre;  // m, from the middle of the grown brick, in its axes
  Vec3 size;    // m
};

struct MortarLayout {
  std::vector<MortarJoint> joints;             // by a, then b
  std::vector<GrownBrick> grown;               // by brick
  std::vector<std::vector<MortarSlab>> slabs;  // by brick; none of layers without thickness
};

// Which bricks are joined: those with parallel faces opposite each other, no further apart than one and a half joints of
// either wall. Bricks of different walls as well. Openings, lintels and cut bricks are what they are in the placements.
MortarLayout layMortar(std::span<const MortaredBricks> walls);

}  // namespace brickfall
