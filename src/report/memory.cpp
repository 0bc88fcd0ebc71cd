// What the system remembers of pairs, as bytes: with it a run goes on bit for bit.
#include "base/archive.h"
#include "report/report_system.h"

namespace brickfall {

void ReportSystem::write(WriteArchive& archive) const {
  archive.value(std::uint64_t(memory_.size()));
  for (const auto& [key, memory] : memory_) {
    archive.value(key.first);
    archive.value(key.second);
    archive.value(std::int32_t(memory.row));
    archive.list(memory.points);
  }
}

bool ReportSystem::read(ReadArchive& archive) {
  std::map<Key, Memory> memory;
  const std::uint64_t count = archive.count(0, 2 * sizeof(std::uint64_t) + sizeof(std::int32_t));
  for (std::uint64_t i = 0; i < count && !archive.failed(); i++) {
    Key key;
    Memory of;
    std::int32_t row = -1;
    archive.value(key.first);
    archive.value(key.second);
    archive.value(row);
    archive.list(of.points);
    if (row < -1 || row >= kObbRows) return false;
    of.row = row;
    memory.emplace(key, std::move(of));
  }
  if (archive.failed()) return false;
  memory_ = std::move(memory);
  collided_.clear();
  return true;
}

}  // namespace brickfall
