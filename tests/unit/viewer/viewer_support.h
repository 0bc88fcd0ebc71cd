// A session without a thread, on a clock that the test sets.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "viewer_core/session.h"

namespace brickfall::viewer {

// A file that is gone after the test.
class TempFile {
 public:
  explicit TempFile(const std::string& name, const std::string& content = {})
      : path_((std::filesystem::temp_directory_path() / ("brickfall-" + std::to_string(::getpid()) + "-" + name))
                  .string()) {
    if (!content.empty()) write(content);
  }
  ~TempFile() {
    std::error_code error;
    std::filesystem::remove(path_, error);
    std::filesystem::remove(path_ + ".part", error);
  }
  const std::string& path() const { return path_; }
  void write(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }
  std::string read() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  bool exists() const { return std::filesystem::exists(path_); }

 private:
  std::string path_;
};

// A small wall of default bricks, which rebound a little.
inline const char* const kWall = R"(
title = "A small wall"
[[wall]]
name = "w"
courses = 5
bricks = 4
[[camera]]
name = "front"
position = [0.4, 0.5, 3]
target = [0.4, 0.2, 0]
)";

// Two cubes: one rests, one falls.
inline const char* const kCubes = R"(
[[body]]
name = "low"
size = [0.2, 0.2, 0.2]
material = "wood"
position = [0, 0.1, 0]
[[body]]
name = "high"
size = [0.2, 0.2, 0.2]
material = "wood"
position = [1, 2, 0]
)";

class TestSession {
 public:
  explicit TestSession(const HistoryLimits& history = {}) : session(options(history, &clock)) {}
  TestSession(const std::string& scene, bool run, const HistoryLimits& history = {})
      : session(options(history, &clock)) {
    TempFile file("scene.toml", scene);
    EXPECT_TRUE(does(Open{file.path(), {}, run}));
  }

  // Carried out at once; the result is kept in `result`.
  bool does(Command command) {
    const std::uint64_t ticket = session.send(std::move(command));
    session.pump();
    for (CommandResult& r : session.takeResults())
      if (r.ticket == ticket) result = std::move(r);
    EXPECT_EQ(result.ticket, ticket);
    return result.ok;
  }
  // The clock goes on by so many seconds, in small pieces.
  void pass(double seconds, double piece = 1.0 / 240) {
    for (double end = clock + seconds; clock < end - 1e-9;) {
      clock += piece;
      session.pump();
    }
  }
  std::shared_ptr<const Frame> frame() const { return session.latest(); }
  Serial serialOf(const std::string& name) const {
    for (const ListedBody& body : frame()->list->bodies)
      if (body.name == name) return body.serial;
    return 0;
  }
  const FrameBody& body(const std::string& name) const {
    held_ = frame();
    const int place = held_->list->find(serialOf(name));
    EXPECT_GE(place, 0) << name;
    static const FrameBody none;
    return place < 0 ? none : held_->bodies[std::size_t(place)];
  }

  double clock = 100;
  CommandResult result;
  Session session;

 private:
  static SessionOptions options(const HistoryLimits& history, const double* clock) {
    SessionOptions o;
    o.history = history;
    o.clock = [clock] { return *clock; };
    o.ownThread = false;
    return o;
  }
  mutable std::shared_ptr<const Frame> held_;
};

// All poses and velocities, bit for bit: two frames are of the same state if they are equal.
inline std::string stateOf(const Frame& frame) {
  std::string bytes;
  const auto add = [&](Vec3 v) { bytes.append(reinterpret_cast<const char*>(&v), sizeof v); };
  for (const FrameBody& body : frame.bodies) {
    add(body.pose.position);
    bytes.append(reinterpret_cast<const char*>(&body.pose.rotation), sizeof body.pose.rotation);
    add(body.linearVelocity);
    add(body.angularVelocity);
  }
  return bytes;
}

}  // namespace brickfall::viewer
