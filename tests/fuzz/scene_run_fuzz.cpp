// libFuzzer: forged snapshots of a scene's run, under the engine and under the report's system. The input is a list of changes to
// the bytes of a real one, to its own part or to its world's, most with both checksums made right again. Whatever comes of it: an
// error that leaves the run as it was, byte for byte, or a run that goes on.
#include "brickfall/scene.h"
#include "fuzz/forged.h"

namespace {

using namespace brickfall;
using fuzz::Bytes;
using fuzz::Change;
using fuzz::require;

using Image = std::vector<std::byte>;

// docs in src/scene/scene_snapshot.cpp and src/world/snapshot.cpp
constexpr std::size_t kHeader = 32, kWorldBytesAt = 16, kHashAt = 24, kWorldHeader = 24, kWorldHashAt = 16;

constexpr const char* kScenes[] = {R"(
[[material]]
name = "clay"
density = 1600
[[wall]]
courses = 2
bricks = 2
density_scatter = 0.1
material = "clay"
[[ball]]
position = [0.2, 1, 0]
launch_time = 0.08
)",
                                   R"(
[world]
method = "report"
[report]
manifold = true
warm_starting = true
[[wall]]
courses = 2
bricks = 2
)"};
constexpr std::size_t kSceneCount = std::size(kScenes);

SceneRun runOf(std::size_t scene) {
  SceneLoad load = parseScene(kScenes[scene], "fuzz.toml");
  require(load.scene.has_value(), "the scene is wrong");
  Result<SceneRun> run = SceneRun::create(*load.scene);
  require(run.ok(), "the scene can't be built");
  return std::move(run).value();
}

Image imageOf(std::size_t scene) {
  SceneRun run = runOf(scene);
  for (int i = 0; i < 4; i++) require(run.step().ok(), "a step is refused");
  return run.snapshot();
}

Image forged(Bytes input, const Image& original, bool resealed) {
  std::uint64_t worldBytes = 0;
  std::memcpy(&worldBytes, original.data() + kWorldBytesAt, sizeof worldBytes);
  const auto world0 = original.begin() + std::ptrdiff_t(kHeader), own0 = world0 + std::ptrdiff_t(worldBytes);
  Image head(original.begin(), world0), world(world0, own0), own(own0, original.end());
  for (Change change; input.take(change);) {
    Image& part = change.kind & 0x80 ? world : own;
    change.kind &= 0x7f;
    fuzz::applyChange(change, part);
  }
  if (resealed) fuzz::seal(world, kWorldHashAt, kWorldHeader);
  worldBytes = world.size();
  std::memcpy(head.data() + kWorldBytesAt, &worldBytes, sizeof worldBytes);
  Image bytes = head;
  bytes.insert(bytes.end(), world.begin(), world.end());
  bytes.insert(bytes.end(), own.begin(), own.end());
  if (resealed) fuzz::seal(bytes, kHashAt, kHeader + world.size());
  return bytes;
}

void goOn(SceneRun& run, bool untouched) {
  for (const std::string& wrong : run.world().validate()) require(false, "restored: " + wrong);
  for (const PlacedBody& body : run.bodies()) {
    require(run.world().isValid(body.id), "a body without a world");
    require(run.find(body.id) == &body, "a body under another's id");
  }
  for (int i = 0; i < 3; i++) {
    const Result<StepReport> report = run.step();  // a launch may be refused: of a body that cannot move
    require(report.ok() || !report.error().message.empty(), "a step is refused without a reason");
    require(report.ok() || !untouched, "a step is refused");
  }
  for (const std::string& wrong : run.world().validate()) require(false, "stepped: " + wrong);
  Material material;
  material.density = 900;
  const Status changed = run.setMaterial("clay", material);
  require(changed.ok() || !changed.error().message.empty(), "a material is refused without a reason");
  const Status again = run.restore(run.snapshot());
  require(again.ok() || !untouched, "its own snapshot is refused: " + again.error().message);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Image originals[kSceneCount] = {imageOf(0), imageOf(1)};
  static std::optional<SceneRun> runs[kSceneCount];
  static Image before[kSceneCount];
  Bytes input(data, size);
  std::uint8_t head = 0;
  input.take(head);
  const std::size_t scene = (head & 0x0f) % kSceneCount;
  if (!runs[scene]) {
    runs[scene] = runOf(scene);
    for (int i = 0; i < 2; i++) require(runs[scene]->step().ok(), "a step is refused");
    before[scene] = runs[scene]->snapshot();
  }
  Image bytes;
  if (head & 0x80) {  // the rest as it is
    bytes.resize(input.size());
    if (!bytes.empty()) std::memcpy(bytes.data(), input.data(), bytes.size());
  } else {
    bytes = forged(input, originals[scene], !(head & 0x40));
  }
  const Status status = runs[scene]->restore(bytes);
  if (status) {
    goOn(*runs[scene], size <= 1);
    require(runs[scene]->restore(before[scene]).ok(), "a run that was forged can't be restored");
  } else {
    require(!status.error().message.empty(), "an error without a reason");
    require(runs[scene]->snapshot() == before[scene], "refused, and changed");
  }
  return 0;
}
