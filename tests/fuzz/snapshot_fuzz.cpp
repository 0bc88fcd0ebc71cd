// libFuzzer: forged snapshots. The input is a list of changes to a real snapshot (so that a new layout makes no kept input
// worthless), most with the checksum made right again. Whatever comes of it: an error that leaves the world as it was, or
// a world that is sound, steps, and can be kept and restored again.
#include "fuzz/forged.h"
#include "support/snapshot_worlds.h"

namespace {

using namespace brickfall;
using fuzz::Bytes;
using fuzz::Change;
using fuzz::require;

constexpr std::size_t kHashAt = 16, kHeader = 24;  // of a snapshot: docs in src/world/snapshot.cpp
void checkSound(const World& world, const char* when) {
  for (const std::string& wrong : world.validate()) require(false, std::string(when) + ": " + wrong);
}

void goOn(World& world, bool forged) {
  checkSound(world, "restored");
  for (BodyId body : world.bodies()) require(world.state(body).ok(), "a body without state");
  world.forEachContact([](const ContactView& view) { require(view.pointCount >= 1, "a contact without points"); });
  (void)world.energy();
  for (int i = 0; i < 3; i++) {
    require(world.step(1.0 / 60).ok(), "a step is refused");
    if (i != 1) checkSound(world, "stepped");
  }
  std::uint64_t hash = world.stateHash();
  Status again = world.restore(world.snapshot());
  // What was forged may have grown beyond what a restored world may hold.
  require(again.ok() || forged, "its own snapshot is refused: " + again.error().message);
  require(world.stateHash() == hash, "its own snapshot is another world");
  for (BodyId body : world.bodies()) require(world.destroyBody(body).ok(), "a body can't be destroyed");
  checkSound(world, "emptied");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::vector<std::byte>> originals = test::snapshotsOfEachKind();
  Bytes input(data, size);
  std::uint8_t head = 0;
  input.take(head);
  std::vector<std::byte> bytes;
  if (head & 0x80) {  // the rest as it is
    bytes.resize(input.size());
    if (!bytes.empty()) std::memcpy(bytes.data(), input.data(), bytes.size());
  } else {
    bytes = originals[(head & 0x0f) % originals.size()];
    for (Change change; input.take(change);) fuzz::applyChange(change, bytes);
  }
  if (!(head & 0x40)) fuzz::seal(bytes, kHashAt, kHeader);

  static World world = test::smallWorld();
  std::uint64_t before = world.stateHash();
  Status status = world.restore(bytes);
  if (status) {
    goOn(world, size > 1);
    world = test::smallWorld();
  } else {
    require(!status.error().message.empty(), "an error without a reason");
    require(world.stateHash() == before && world.bodies().size() == 2, "refused, and changed");
  }
  return 0;
}
