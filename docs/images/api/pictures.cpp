// Does what some snippets of docs/game-programmers.md say, for their pictures: pictures FOLDER leaves takes, and texts of what was
// printed and measured. tools/api-pictures builds it, runs it and draws the rest.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "brickfall/brickfall.h"
#include "brickfall/take_recorder.h"

using namespace brickfall;

namespace {

constexpr double kDt = 1.0 / 60;
const Vec3 kBrick{0.215, 0.065, 0.1025};
std::string folder;
FILE* page = nullptr;  // of what a snippet prints

FILE* open(const std::string& name) { return std::fopen((folder + "/" + name).c_str(), "w"); }

// A take of a world, with colours by body.
struct Film {
  Film(const std::string& name, World& filmed, const Camera& camera)
      : world(filmed), path(folder + "/" + name + ".take") {
    header.scene = header.title = name;
    header.cameras = {camera};
  }
  void begin() { recorder.emplace(TakeRecorder::create(path, header, world, describe()).value()); }
  void run(int steps) {
    for (int i = 0; i < steps; i++) {
      const StepReport report = world.step(kDt).value();
      (void)recorder->afterStep(world, report, describe());
    }
  }
  void end() { (void)recorder->finish(""); }
  TakeRecorder::Describe describe() {
    return [this](BodyId id) {
      TakeBody body;
      const BodyState now = *world.state(id);
      body.name = "body " + std::to_string(id.index);
      body.mass = now.mass;
      const auto look = looks.find(id);
      body.material = look == looks.end() ? "brick" : look->second.first;
      body.colour = look == looks.end() ? 0xB5543A : look->second.second;
      body.role = world.shape(world.shapes(id)[0])->type == ShapeType::plane ? BodyRole::ground : BodyRole::body;
      return body;
    };
  }
  World& world;
  std::string path;
  TakeHeader header;
  std::optional<TakeRecorder> recorder;
  std::unordered_map<BodyId, std::pair<std::string, std::uint32_t>> looks;
};

Camera camera(Vec3 position, Vec3 target, double degrees) {
  Camera out;
  out.position = position;
  out.target = target;
  out.fieldOfViewDegrees = degrees;
  return out;
}

void errors() {
  World world = World::create({}).value();
  page = open("errors.txt");
  const auto tell = [](const char* call, const std::string& message) {
    std::fprintf(page, "> %s\n%s\n", call, message.c_str());
  };
  tell("world.createBody(ballBody(-1))", world.createBody(ballBody(-1)).error().message);
  const BodyId brick = world.createBody(boxBody(kBrick)).value();
  tell("world.setLinearVelocity(brick, {0, infinity, 0})",
       world.setLinearVelocity(brick, {0, std::numeric_limits<double>::infinity(), 0}).error().message);
  tell("world.step(1)", world.step(1).error().message);
  (void)world.destroyBody(brick);
  tell("world.applyImpulse(brick, {0, 5, 0})", world.applyImpulse(brick, {0, 5, 0}).error().message);
  std::fclose(page);
}

void log() {
  page = open("log.txt");
  setNoteHandler([](const Note& note) { std::fprintf(page, "brickfall: %s\n", note.text); });
  World world = World::create({}).value();
  BodyId last = world.createBody(groundPlane()).value();
  std::vector<BodyId> links;
  for (int i = 0; i < 3; i++) {
    links.push_back(world.createBody(ballBody(0.1, {}, {0.3 * i, 2, 0})).value());
    JointDef joint;
    joint.bodyA = last;
    joint.bodyB = last = links.back();
    joint.anchor = {0.3 * i - 0.15, 2, 0};
    (void)world.createJoint(joint);
  }
  std::fprintf(page, "> world.destroyBody(links[1])\n");
  (void)world.destroyBody(links[1]);
  const BodyId tiny = world.createBody(boxBody({2e-3, 2e-3, 2e-3}, {}, {0, 5, 0})).value();
  std::fprintf(page, "> world.applyForce(tiny, {1e12, 0, 0}) before each step\n");
  for (int i = 0; i < 120 && !world.state(tiny)->quarantined; i++) {
    (void)world.applyForce(tiny, {1e12, 1e12, 0});
    (void)world.step(kDt);
  }
  setNoteHandler(nullptr);
  std::fclose(page);
}

// Five bricks; one goes, and a ball has its number, but not its id.
void ids() {
  World world = World::create({}).value();
  Film film("ids", world, camera({0.1, 0.65, 1.6}, {0.02, 0.07, 0}, 28));
  (void)world.createBody(groundPlane());
  std::vector<BodyId> bricks;
  for (int i = 0; i < 5; i++)
    bricks.push_back(world.createBody(boxBody(kBrick, {}, {0.28 * (i - 2), kBrick.y / 2, 0})).value());
  FILE* list = open("ids.txt");
  const auto write = [&](int frame, const char* sign, BodyId id, Vec3 at) {
    std::fprintf(list, "%d %g %g %g %s %u.%u\n", frame, at.x, at.y + 0.07, at.z, sign, id.index, id.generation);
  };
  film.begin();
  for (BodyId id : bricks) write(0, "", id, world.state(id)->position);
  const BodyId gone = bricks[3];
  const Vec3 place = world.state(gone)->position;
  (void)world.destroyBody(gone);
  const BodyId ball = world.createBody(ballBody(0.06, {}, place + Vec3{0, 0.03, 0})).value();
  film.looks[ball] = {"rubber", 0x3B6EA5};
  film.run(2);
  for (BodyId id : world.bodies())
    if (world.massProperties(id)->mass > 0)
      write(2, "", id, world.state(id)->position + Vec3{0, id == ball ? 0.03 : 0, 0});
  std::fprintf(list, "> world.isValid(BodyId %u.%u): %s; of %u.%u: %s\n", gone.index, gone.generation,
               world.isValid(gone) ? "true" : "false", ball.index, ball.generation,
               world.isValid(ball) ? "true" : "false");
  std::fclose(list);
  film.end();
}

// Two gates, one of them switched off; a ball rolls to each.
void off() {
  World world = World::create({}).value();
  Film film("off", world, camera({1.3, 1.9, 2.7}, {0, 0.1, -0.35}, 30));
  (void)world.createBody(groundPlane());
  for (const double x : {-0.5, 0.5}) {
    const BodyId gate = world.createBody(boxBody({0.7, 0.4, 0.05}, Material{.density = 7800}, {x, 0.2, 0})).value();
    film.looks[gate] = {"wood", x < 0 ? 0xA06A3Cu : 0x2E9E6Bu};
    (void)world.setEnabled(gate, x < 0);
    BodyDef def = ballBody(0.14, {}, {x, 0.14, 1.1});
    def.linearVelocity = {0, 0, -3};
    film.looks[world.createBody(def).value()] = {"rubber", 0xE08A2E};
  }
  film.begin();
  film.run(45);
  film.end();
}

// Blue balls may not meet the board.
void filter() {
  World world = World::create({}).value();
  Film film("filter", world, camera({0.7, 1.1, 2.9}, {0, 0.36, 0}, 32));
  BodyDef board = boxBody({1.7, 0.05, 0.5}, {}, {0, 0.5, 0});
  board.type = BodyType::fixed;
  (void)world.createBody(groundPlane());
  const ShapeId top = world.shapes(world.createBody(board).value())[0];
  std::vector<ShapeId> blue;
  (void)world.setContactFilter([&](ShapeId a, ShapeId b) {
    const ShapeId other = a == top ? b : a;
    return (a != top && b != top) || std::find(blue.begin(), blue.end(), other) == blue.end();
  });
  film.looks[world.bodies()[1]] = {"wood", 0xB98A55};
  for (int i = 0; i < 6; i++) {
    const BodyId ball = world.createBody(ballBody(0.1, {}, {0.27 * (i - 2.5), 0.75, 0})).value();
    if (i % 2) blue.push_back(world.shapes(ball)[0]);
    film.looks[ball] = {"rubber", i % 2 ? 0x3B6EA5u : 0xE08A2Eu};
  }
  film.begin();
  film.run(50);
  film.end();
}

// Saved in the middle of a fall, gone on with, restored.
void save() {
  World world = World::create({}).value();
  Film film("save", world, camera({1.1, 0.9, 2.2}, {0, 0.3, 0}, 32));
  (void)world.createBody(groundPlane());
  for (int row = 0; row < 8; row++)
    for (int i = 0; i < 5; i++)
      (void)world.createBody(
          boxBody(kBrick, {}, {0.225 * (i - 2) + (row % 2 ? 0.1125 : 0), kBrick.y * (row + 0.5), 0}));
  BodyDef def = ballBody(0.1, Material{.density = 7800}, {0.1, 0.3, 1.2});
  def.linearVelocity = {0, 0.8, -9};
  film.looks[world.createBody(def).value()] = {"steel", 0x5B6068};
  for (int i = 0; i < 12; i++) (void)world.step(kDt);
  film.begin();
  film.end();
  FILE* hashes = open("save.txt");
  const auto hash = [&] { std::fprintf(hashes, "%016llx\n", static_cast<unsigned long long>(world.stateHash())); };
  hash();
  const std::vector<std::byte> saved = world.snapshot();
  for (int i = 0; i < 24; i++) (void)world.step(kDt);
  hash();
  film.path = folder + "/later.take";
  film.begin();
  film.end();
  (void)world.restore(saved);
  hash();
  film.path = folder + "/restored.take";
  film.begin();
  film.end();
  std::fclose(hashes);
}

// s of processor time of this thread.
double spent() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// As many threads as it says, on one: each piece of a loop goes to whoever is free first, by the processor time that it took. So the
// time of a step on a machine of that many idle cores is known on any machine, but for what handing over takes.
struct Shared final : TaskSystem {
  explicit Shared(int threads) : count(threads) {}
  int count;
  double saved = 0;  // s, against one thread
  int threads() const override { return count; }
  void forRange(int end, int grain, const std::function<void(int, int)>& body) override {
    std::vector<double> busy(std::size_t(count), 0.0);
    double all = 0;
    for (int begin = 0; begin < end; begin += grain) {
      const double start = spent();
      body(begin, std::min(end, begin + grain));
      const double piece = spent() - start;
      all += piece;
      *std::min_element(busy.begin(), busy.end()) += piece;
    }
    saved += all - *std::max_element(busy.begin(), busy.end());
  }
};

// Sixteen walls, a ball into each: islands of their own, which threads share.
void threads() {
  FILE* list = open("threads.txt");
  for (int count : {1, 2, 4, 8, 16}) {
    Shared tasks(count);
    WorldDef def;
    def.tasks = &tasks;
    def.enableSleep = false;
    World world = World::create(def).value();
    (void)world.createBody(groundPlane());
    for (int wall = 0; wall < 16; wall++) {
      for (int row = 0; row < 8; row++)
        for (int i = 0; i < 8; i++)
          (void)world.createBody(
              boxBody(kBrick, {}, {0.225 * (i - 4) + (row % 2 ? 0.1125 : 0), kBrick.y * (row + 0.5), 3.0 * wall}));
      BodyDef ball = ballBody(0.1, Material{.density = 7800}, {0.1, 0.3, 3.0 * wall + 0.6});
      ball.linearVelocity = {0, 0.5, -8};
      (void)world.createBody(ball);
    }
    const double start = spent();
    for (int step = 0; step < 60; step++) (void)world.step(kDt);
    std::fprintf(list, "%d %.3f %016llx\n", count, (spent() - start - tasks.saved) / 60 * 1000,
                 static_cast<unsigned long long>(world.stateHash()));
  }
  std::fclose(list);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  folder = argv[1];
  errors();
  log();
  ids();
  off();
  filter();
  save();
  if (argc > 2) threads();  // it measures time
  return 0;
}
