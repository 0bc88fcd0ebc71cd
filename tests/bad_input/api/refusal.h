// What a wrong call must do: answer with an error value that names the field, and leave every byte of the world as it was.
#pragma once
#include <cstring>
#include <limits>

#include "support/world_helpers.h"

namespace brickfall::test {

inline const double kNan = std::numeric_limits<double>::quiet_NaN();
inline const double kInf = std::numeric_limits<double>::infinity();

// Compares snapshots: bodies, contacts, islands, forces, settings, all that a step reads.
class Unchanged {
 public:
  explicit Unchanged(World& world) : world_(world), before_(world.snapshot()) {}

  template <class Answer> void refuses(const Answer& answer, ErrorCode code, const std::string& field) {
    calls_++;
    ASSERT_FALSE(answer.ok()) << field << " was accepted";
    EXPECT_EQ(int(answer.error().code), int(code)) << answer.error().message;
    EXPECT_NE(answer.error().message.find(field), std::string::npos)
        << "\"" << answer.error().message << "\" does not name " << field;
    expectSame(field);
  }
  // A number out of range: what was found and what was expected stand in the message.
  template <class Answer> void refusesValue(const Answer& answer, const std::string& field) {
    refuses(answer, ErrorCode::invalidArgument, field);
    if (answer.ok()) return;
    const std::string& text = answer.error().message;
    EXPECT_NE(text.find("found"), std::string::npos) << text;
    EXPECT_NE(text.find("expected"), std::string::npos) << text;
  }
  void expectSame(const std::string& after) {
    std::vector<std::byte> now = world_.snapshot();
    EXPECT_TRUE(now == before_) << "the world changed: " << after;
  }
  int calls() const { return calls_; }

 private:
  World& world_;
  std::vector<std::byte> before_;
  int calls_ = 0;
};

// A heap in the middle of things: bodies of all kinds, contacts, forces, one island asleep.
struct LivedIn {
  World world = makeWorld();
  BodyId ground, wall, paddle, box, ball, sleeper;

  LivedIn() {
    ground = addGround(world);
    wall = add(world, bodyOf(boxOf({0.1, 1, 1}), {3, 1, 0}, BodyType::fixed));
    BodyDef k = bodyOf(boxOf({0.2, 0.2, 0.2}), {6, 1, 0}, BodyType::kinematic);
    k.angularVelocity = {0, 1, 0};
    paddle = add(world, k);
    sleeper = addBox(world, {0.2, 0.2, 0.2}, {-6, 0.2, 0});
    run(world, 2);
    EXPECT_FALSE(world.state(sleeper)->awake);
    box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.25, 0}, {5, 0, 0});
    ball = add(world, bodyOf(sphereOf(0.2), {0.9, 0.7, 0}));
    run(world, 0.3);
    EXPECT_TRUE(world.applyForce(box, {1, 2, 3}).ok());
  }
};

}  // namespace brickfall::test
