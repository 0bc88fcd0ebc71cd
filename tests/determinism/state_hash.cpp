// Prints the state hash of some scenes: the same bits are expected from every build of the engine, on any number of threads
// (the one argument; 1 without it).
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "support/input_list.h"
#include "support/lab_scenes.h"
#include "support/mortared_wall.h"

using namespace brickfall;

namespace {

int threads = 1;

World makeWorld() {
  WorldDef def;
  def.threads = threads;
  return std::move(World::create(def)).value();
}

void print(const char* name, double restitution, double gap, double seconds, double dt) {
  lab::Options o;
  o.restitution = restitution;
  o.gap = gap;
  o.seed = 1;
  o.threads = threads;
  lab::Scene s = lab::make(name, o);
  for (int n = int(std::lround(seconds / dt)); n > 0; n--)
    if (!s.world.step(dt)) std::printf("a step failed\n");
  std::printf("%s e %.1f gap %.1f mm, %.2f s of 1/%ld s: %016" PRIx64 "\n", name, restitution, gap * 1e3, seconds,
              std::lround(1 / dt), s.world.stateHash());
}

// Every pair of shapes, a kinematic body, and spins.
void printPile() {
  World world = makeWorld();
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shapes.resize(1);
  ground.shapes[0].type = ShapeType::plane;
  bool fine = world.createBody(ground).ok();
  lab::LabRandom random(3);
  for (int i = 0; i < 32; i++) {
    BodyDef d;
    d.shapes.resize(1);
    ShapeDef& s = d.shapes[0];
    s.type = i < 24 ? ShapeType(i % 4) : i % 2 ? ShapeType::cylinder : ShapeType::cone;
    s.halfExtents = {0.1, 0.15, 0.2};
    s.radius = 0.1;
    s.halfHeight = 0.15;
    s.vertices = {{.2, 0, 0}, {-.2, 0, 0}, {0, .2, 0}, {0, -.2, 0}, {0, 0, .2}, {0, 0, -.2}};
    s.material.restitution = 0.3;
    d.position = {random.unit() - 0.5, 0.3 + 0.3 * i, random.unit() - 0.5};
    d.rotation = {random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5, 1};
    d.angularVelocity = {10 * random.unit(), 10 * random.unit(), 10 * random.unit()};
    d.linearDamping = 0.1;
    d.dragArea = 0.01;
    fine = world.createBody(d).ok() && fine;
  }
  for (int i = 0; i < 120; i++) fine = world.step(1.0 / 60).ok() && fine;
  std::printf("pile%s: %016" PRIx64 "\n", fine ? "" : " failed", world.stateHash());
}

// Joints crack and break; what holds is a chunk.
void printMortar() {
  WorldDef def;
  def.threads = threads;
  test::MortaredWall wall = test::mortaredWall(5, 5, 12, def);
  bool fine = true;
  for (int i = 0; i < 30; i++) fine = wall.world.step(1.0 / 60).ok() && fine;
  std::printf("mortar%s: %016" PRIx64 "\n", fine ? "" : " failed", wall.world.stateHash());
}

// Calls of every kind between the steps; the hash is over all of them.
void printInputs(int seed) {
  World world = makeWorld();
  test::Played played = test::play(test::randomInputs(seed, 120), world);
  std::uint64_t sum = 0;
  for (std::uint64_t hash : played.hashes) sum = sum * 31 + hash;
  std::printf("inputs %d, %d refused: %016" PRIx64 "\n", seed, played.refused, sum);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) threads = std::atoi(argv[1]);
  print("w10", 0, 0, 0.5, 1.0 / 60);
  print("w10", 0, 0.1e-3, 0.5, 1.0 / 120);
  print("drop", 0.3, 0, 0.7, 1.0 / 60);
  print("tumble", 0.5, 0, 2, 1.0 / 60);
  print("cor25", 0, 0, 0.5, 1.0 / 60);
  print("hit0", 0.3, 0, 0.1, 1.0 / 60);
  print("hole10", 0, 0, 0.08, 1.0 / 60);
  printPile();
  printMortar();
  printInputs(1);
  printInputs(2);
}
