// A take: what happened in a run, frame by frame, on disk. Written as the run goes, so that a run killed at any moment
// leaves a take that opens up to its last whole frame. docs/take-format.md documents the bytes.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brickfall/math.h"
#include "brickfall/mortar.h"
#include "brickfall/result.h"
#include "brickfall/scenery.h"
#include "brickfall/shapes.h"

namespace brickfall {

// A body is known by its number: bodies are counted from 0 over the whole take, in the order in which they came.
struct TakeBody {
  std::string name;
  BodyRole role = BodyRole::body;
  std::uint32_t colour = 0xB5543A;          // 0xRRGGBB
  double mass = 0;                          // kg, 0 = fixed
  std::vector<ShapeDef> shapes;             // geometry and local pose; of their materials only the names, below
  std::string material;                     // its name in the scene; empty: not known
  std::vector<std::string> shapeMaterials;  // one per shape; empty: `material` for all
  // 0xRRGGBB, one per shape; empty: `colour`, and of another material the usual one of its stuff.
  std::vector<std::uint32_t> shapeColours;
  // By which it differs in looks from others of its stuff: its place in the world. A reader always has one: its number in a take
  // that says nothing.
  std::optional<std::uint32_t> look;
};

// A mortar joint, known by its number: joints are counted as bodies are, by themselves.
struct TakeMortar {
  std::uint32_t bodyA = 0, bodyB = 0;  // numbers of bodies
  Vec3 centre;                         // m, frame of A
  Vec3 along1, along2;                 // m, frame of A: half edges of its face (MortarState)
};

struct TakeHeader {
  std::string scene, title, engineVersion;
  std::uint64_t seed = 0;
  double framesPerSecond = 60;
  std::vector<Camera> cameras;
};

// The frames in which a body, or a joint, is there: from `birth` up to, not including, `end`.
struct TakeLife {
  std::size_t birth = 0, end = 0;
  bool holds(std::size_t frame) const { return frame >= birth && frame < end; }
};

struct TakePose {
  Vec3 position;           // m, body origin; kept to 0.01 mm or better
  Quat rotation;           // kept to 1e-4 rad or better
  float speed = 0;         // m/s
  float contactForce = 0;  // N, sum of normal forces on the body
};

enum class TakeEventType : std::uint8_t { hit, launch, fellAsleep, quarantined };
struct TakeEvent {
  TakeEventType type = TakeEventType::hit;
  std::uint32_t bodyA = 0, bodyB = 0;  // numbers of bodies that are or were there; bodyB only for hits
  Vec3 pointWorld;                     // m
  float impulse = 0;                   // N s
};

// 0 .. 1 both, kept to 1 / 255. Broken: damage is 1.
struct TakeMortarState {
  float utilisation = 0, damage = 0;
};

// As LoadTaker.
struct TakeLoadTaker {
  static constexpr std::uint32_t kContacts = 0xffffffffu;
  std::uint32_t mortar = kContacts;    // number of a joint; kContacts: contacts of the two bodies
  std::uint32_t bodyA = 0, bodyB = 0;  // numbers
  float before = 0, after = 0;         // N
};

// How a joint broke, as MortarPast. In the take from .05 s after it broke on.
struct TakeBreak {
  std::uint32_t mortar = 0;             // number
  double crackTime = 0, breakTime = 0;  // s
  MortarMode mode = MortarMode::none;
  float tensionShare = 0, shearShare = 0;
  Vec3 force;  // N, from A on B, before it opened; kept as floats
  std::vector<TakeLoadTaker> takers;
};

struct TakeFrame {
  double time = 0;                      // s
  std::vector<TakePose> poses;          // one per body that is there, in the order of their numbers
  std::vector<TakeEvent> events;        // since the last frame
  std::vector<TakeMortarState> mortar;  // one per joint that is there, in the order of their numbers
  std::vector<TakeBreak> breaks;        // known since the last frame
};

// Who comes and who goes with a frame.
struct TakeChange {
  std::vector<TakeBody> births;     // there from this frame on; their numbers follow those of all bodies before
  std::vector<std::uint32_t> ends;  // numbers of bodies that were there in the last frame and no longer are, ascending
  std::vector<TakeMortar> mortar;   // joints that come, numbered likewise
  std::vector<std::uint32_t> mortarEnds;  // numbers of joints that go, ascending
  bool any() const { return !births.empty() || !ends.empty() || !mortar.empty() || !mortarEnds.empty(); }
};

// Whether bytes that begin like this are a take's (at least the first 8 are needed): tells takes from other files.
bool isTake(std::string_view start);

class TakeWriter {
 public:
  // Creates (replaces) the file at once; frames are flushed one by one.
  static Result<TakeWriter> create(const std::string& path, const TakeHeader& header);
  TakeWriter(TakeWriter&&) noexcept;
  TakeWriter& operator=(TakeWriter&&) noexcept;
  ~TakeWriter();
  // The first frame's change brings the bodies that are there at the start.
  Status write(const TakeFrame& frame, const TakeChange& change = {});
  // Writes the index and `summaryJson` (any text, may be empty); without it the take still opens.
  Status finish(const std::string& summaryJson);

 private:
  struct Impl;
  explicit TakeWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

class TakeReader {
 public:
  // Opens a take; a cut-off one up to its last whole frame (complete() is then false).
  static Result<TakeReader> open(const std::string& path);
  static Result<TakeReader> openBytes(std::vector<std::uint8_t> bytes);
  TakeReader(TakeReader&&) noexcept;
  TakeReader& operator=(TakeReader&&) noexcept;
  ~TakeReader();
  const TakeHeader& header() const;
  std::size_t frameCount() const;
  const std::vector<TakeBody>& bodies() const;  // all that ever were there, by number
  const std::vector<TakeLife>& lives() const;   // of each body
  // Numbers of the bodies that are there in a frame, ascending: those to which TakeFrame::poses belong.
  std::vector<std::uint32_t> bodiesAt(std::size_t frame) const;
  // All mortar joints that ever were there, by number, and their lives; those of a frame, ascending.
  const std::vector<TakeMortar>& mortar() const;
  const std::vector<TakeLife>& mortarLives() const;
  std::vector<std::uint32_t> mortarAt(std::size_t frame) const;
  bool complete() const;
  // Of a take that was cut off: bytes after its last whole frame, which belong to a torn one.
  std::uint64_t tornBytes() const;
  const std::string& summaryJson() const;
  // Any order; frames in order are the fastest. Keeps its place between calls, so not from two threads at once.
  Result<TakeFrame> frame(std::size_t index) const;

 private:
  struct Impl;
  explicit TakeReader(std::unique_ptr<Impl> impl);
  static Result<TakeReader> openImpl(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace brickfall
