// libFuzzer: forged snapshots. The input is a list of changes to a real snapshot (so that a new layout makes no kept input
// worthless), most with the checksum made right again. Whatever comes of it: an error that leaves the world as it was, or
// a world that is sound, steps, and can be kept and restored again.
#include <bit>
#include <limits>

#include "base/hash.h"
#include "fuzz/fuzz_check.h"
#include "support/snapshot_worlds.h"

namespace {

using namespace brickfall;
using fuzz::Bytes;
using fuzz::require;

constexpr std::size_t kHashAt = 16, kHeader = 24;  // of a snapshot: docs in src/world/snapshot.cpp
constexpr double kDoubles[] = {0.0,
                               -0.0,
                               1,
                               -1,
                               0.5,
                               1e-300,
                               1e-30,
                               1e10,
                               1e30,
                               1e300,
                               std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()};
constexpr std::uint32_t kWords[] = {0, 1, 2, 3, 4, 5, 7, 8, 16, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};

struct Change {
  std::uint8_t kind, value, at[3], from[3];
};

std::size_t placeOf(const std::uint8_t (&at)[3], std::size_t size) {
  return (at[0] | std::size_t(at[1]) << 8 | std::size_t(at[2]) << 16) % size;
}

void put(std::vector<std::byte>& bytes, std::size_t at, const void* data, std::size_t size) {
  size = std::min(size, bytes.size() - at);
  std::memcpy(bytes.data() + at, data, size);
}

void applyChange(const Change& c, std::vector<std::byte>& bytes) {
  if (bytes.empty()) return;
  std::size_t at = placeOf(c.at, bytes.size()), from = placeOf(c.from, bytes.size());
  double d = kDoubles[c.value % std::size(kDoubles)];
  float f = float(d);
  std::uint32_t word = kWords[c.value % std::size(kWords)];
  std::size_t length = std::min<std::size_t>(c.value, bytes.size() - std::max(at, from));
  auto here = bytes.begin() + std::ptrdiff_t(at);
  switch (c.kind % 9) {
    case 0:
      bytes[at] = std::byte(c.value);
      break;
    case 1:
      bytes[at] ^= std::byte(c.value);
      break;
    case 2:
      put(bytes, at, &d, sizeof d);
      break;
    case 3:
      put(bytes, at, &f, sizeof f);
      break;
    case 4:
      put(bytes, at, &word, sizeof word);
      break;
    case 5:
      std::memmove(&bytes[at], &bytes[from], length);
      break;
    case 6:
      bytes.insert(here, c.value, std::byte(c.from[0]));
      break;
    case 7:
      bytes.erase(here, here + std::ptrdiff_t(length));
      break;
    default:
      std::swap(bytes[at], bytes[from]);
  }
}

void recomputeHash(std::vector<std::byte>& bytes) {
  if (bytes.size() < kHeader) return;
  Hash hash;
  for (std::size_t i = kHeader; i < bytes.size(); i++) hash.addByte(std::uint8_t(bytes[i]));
  std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + kHashAt, &value, sizeof value);
}

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
    for (Change change; input.take(change);) applyChange(change, bytes);
  }
  if (!(head & 0x40)) recomputeHash(bytes);

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
