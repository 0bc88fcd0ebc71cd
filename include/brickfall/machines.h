// What loads bodies besides gravity: bodies that are driven along a path, tables that tilt and shake, wind, blasts, aimed shots.
// All of it acts between two steps, through the world's own calls, while it has its time: before and after, nothing is touched
// and what rests goes on resting. Library: brickfall::machines.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brickfall/world.h"

namespace brickfall {

// --- Numbers and poses over time

// smooth: starts and ends softly, passes each key without a jerk and never goes beyond it, stands between two that are equal.
enum class Interpolation : std::uint8_t { smooth, linear };

// Before its first key it has the first value, after its last the last.
struct Track {
  std::vector<std::pair<double, double>> keys;  // s, value; times ascend
  Interpolation interpolation = Interpolation::smooth;
  double at(double time) const;
};

struct MotionKey {
  double time = 0;  // s
  Vec3 position;    // m, of the body's origin
  Quat rotation;    // from the key before it turns the short way round
};
struct MotionPath {
  std::vector<MotionKey> keys;  // times ascend
  Interpolation interpolation = Interpolation::smooth;
  Transform at(double time) const;
};

// Velocities with which a kinematic body is at `target` after a step of dt: for what a program moves by itself. From a turn of
// half a circle on, the short way round.
Status driveTo(World& world, BodyId body, const Transform& target, double dt);

// --- Tilt and shake

// Turns a body, or all loads of the world, about an axis.
struct Tilt {
  Vec3 axis{0, 0, 1};  // its length does not matter
  Vec3 pivot;          // m, a point of the axis
  Track angle;         // rad
};

// Accelerations as an instrument wrote them down, one number a sample, any sampling.
struct AccelerationRecord {
  std::vector<double> times;   // s, ascending
  std::vector<double> values;  // m/s2
};
struct RecordFormat {
  double unit = 1;      // m/s2 in one unit of the file
  double timeUnit = 1;  // s in one unit of the file
  int column = 1;       // that is read, counted from the one after the time
};
// Lines of numbers between commas, semicolons or blanks, the time first. Empty lines, what follows a # and one line of names at
// the top are passed over. An error names the line: a value that is missing or no finite number, times that do not ascend, an
// interval of more than ten times the usual one (the median): a gap.
Result<AccelerationRecord> readAccelerationRecord(std::string_view text, const std::string& name,
                                                  const RecordFormat& format);

enum class ShakeSignal : std::uint8_t {
  record,     // of Shake::record
  sine,       // of `amplitude` and `frequency` for `seconds`, grown and died away over `ramp` each; ends where it began
  fullPulse,  // one whole sine of `seconds`: ends at rest, elsewhere
  halfPulse,  // half a sine of `seconds`: ends with a speed, and goes on at it
  squarePulse,  // `amplitude` for `seconds`; the same
};
// The speed and the place that the sums of a record end with. none: kept; a body goes on at that speed. rest: the one straight line
// is taken from the accelerations after which both are 0.
enum class Baseline : std::uint8_t { rest, none };

struct Shake {
  Vec3 direction{1, 0, 0};  // its length does not matter
  double start = 0;         // s
  ShakeSignal signal = ShakeSignal::sine;
  double amplitude = 1;  // m/s2; of a record: a factor
  double frequency = 1;  // 1/s
  double seconds = 1;
  double ramp = 1;  // s
  Baseline baseline = Baseline::rest;
  AccelerationRecord record;
};

// A shake's motion, its accelerations summed up without an error of steps (a record: straight lines between samples).
class ShakeMotion {
 public:
  struct State {
    double acceleration = 0, velocity = 0, displacement = 0;  // m/s2, m/s, m
  };
  static Result<ShakeMotion> create(const Shake& shake);
  State at(double time) const;
  Vec3 direction() const { return direction_; }  // unit
  double start() const { return shake_.start; }
  double end() const { return end_; }  // s: from then on it stands, or goes on at a speed
  bool endsAtRest() const { return last_.velocity == 0; }
  double correction() const { return correction_; }  // m/s2: the most that the baseline took from a sample

 private:
  State inside(double since) const;
  Shake shake_;
  Vec3 direction_;
  double end_ = 0, correction_ = 0;
  State last_;
  std::vector<State> states_;  // of a record, at its samples
};

// --- Air and blasts

// Presses on faces towards it and draws at faces away from it, by the air's density and the square of the relative speed along
// the normal. Nothing gains more than the wind has: the force follows the speed within the step.
struct Wind {
  Vec3 velocity;                                                     // m/s
  double from = 0, until = std::numeric_limits<double>::infinity();  // s
  double ramp = 0;                                                   // s: so long it grows, and so long it dies away
  double dragCoefficient = 1.3;  // of a plate across the wind; 8/13 of it press, 5/13 draw
  bool shelter = true;           // what stands before a face keeps the wind from it
};
// Forces of the wind at `time` on all dynamic bodies, for the next step of dt. A body's own drag area is that of still air and
// comes on top: where wind blows, give none. Errors name the field: `time` is finite, `dt` above 0 s, 1e6 at most.
Status applyWind(World& world, const Wind& wind, double time, double dt);

// An impulse that spreads from a point: the share of a face is its solid angle, and acts away from the point.
struct Blast {
  Vec3 centre;            // m
  double impulse = 0;     // N s, >= 0, over all directions together
  double radius = 1;      // m, > 0: no face beyond feels it
  double time = 0;        // s
  bool occlusion = true;  // what is hidden from the centre feels nothing
};
struct BlastReport {
  int bodies = 0;      // that were pushed
  double impulse = 0;  // N s, that they took, without regard to its direction
};
Result<BlastReport> applyBlast(World& world, const Blast& blast);

// The velocity of a shot of `speed` that flies from one point through another, in no air. flat: the sooner of the two ways.
// Where the speed does not reach it, the error tells the least that does.
Result<Vec3> aim(Vec3 from, Vec3 target, double speed, Vec3 gravity, bool flat = true);

// --- All of it together

// A body takes its path first, then all tilts, then the sum of all shakes. Without a path that starts from how it stood when it was
// added.
class Machines {
 public:
  // The body must be kinematic. A path is where it will be, wherever it is now.
  Status follow(const World& world, BodyId body, const MotionPath& path);
  Status tilt(const World& world, BodyId body, const Tilt& tilt);
  Status shake(const World& world, BodyId body, const Shake& shake);
  // As if the ground did it, in its frame: gravity turns, or has what a shaken ground would add. (Nothing is seen to move.)
  Status tiltAll(const World& world, const Tilt& tilt);
  Status shakeAll(const World& world, const Shake& shake);
  Status add(const Wind& wind);
  Status add(const Blast& blast);

  // Before the step that leads from `time` to `time` + dt.
  Status act(World& world, double time, double dt);
  bool empty() const { return drives_.empty() && loads_.idle() && winds_.empty() && blasts_.empty(); }

  // The only state: what began before this has been done. For snapshots.
  double actedUntil() const { return actedUntil_; }
  void setActedUntil(double time) { actedUntil_ = time; }

 private:
  // What moves one body, or the frame of all loads.
  struct Drive {
    BodyId body;
    Transform base;
    MotionPath path;
    std::vector<Tilt> tilts;
    std::vector<ShakeMotion> shakes;
    bool idle() const { return path.keys.empty() && tilts.empty() && shakes.empty(); }
    double begin() const;
    double end() const;
    Transform at(double time) const;
  };
  Result<Drive*> driveOf(const World& world, BodyId body);
  Status move(World& world, const Drive& drive, double time, double dt) const;
  Status turnLoads(World& world, double time, double dt) const;

  std::vector<Drive> drives_;
  Drive loads_;
  Vec3 gravity_;  // that loads_ turns
  std::vector<Wind> winds_;
  std::vector<Blast> blasts_;
  double actedUntil_ = -std::numeric_limits<double>::infinity();
};

}  // namespace brickfall
