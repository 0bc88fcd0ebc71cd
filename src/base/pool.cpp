#include "base/pool.h"

#include <algorithm>
#include <bit>
#include <new>

#include "base/assert.h"

namespace brickfall {

namespace {

constexpr int kSmallestChunk = 10;  // 64 KiB

}  // namespace

Pool::~Pool() {
  for (Chunk& chunk : chunks_)
    if (upstream_)
      upstream_->deallocate(chunk.memory, kUnit << chunk.order, kUnit);
    else
      ::operator delete(chunk.memory, std::align_val_t(kUnit));
}

int Pool::orderFor(std::size_t bytes) {
  std::size_t units = std::max<std::size_t>(1, (bytes + kUnit - 1) / kUnit);
  return int(std::bit_width(units - 1));
}

void Pool::reserve(std::size_t bytes) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (bytes > capacity_) addChunk(std::max({kSmallestChunk, orderFor(bytes - capacity_), orderFor(capacity_)}));
}

void Pool::addChunk(int order) {
  BRICKFALL_ASSERT(order < kOrders, "more memory than a machine has");
  std::size_t units = std::size_t(1) << order;
  void* memory =
      upstream_ ? upstream_->allocate(units * kUnit, kUnit) : ::operator new(units* kUnit, std::align_val_t(kUnit));
  Chunk chunk{static_cast<std::byte*>(memory), order, {}};
  chunk.freeAt.resize(units, 0);
  capacity_ += units * kUnit;
  chunks_.push_back(std::move(chunk));
  putFree(chunks_.back(), chunks_.back().memory, order);
}

// There are few: each new one is at least as large as all others together.
Pool::Chunk& Pool::chunkOf(const void* memory) {
  const std::byte* at = static_cast<const std::byte*>(memory);
  for (Chunk& chunk : chunks_)
    if (at >= chunk.memory && at < chunk.memory + (kUnit << chunk.order)) return chunk;
  BRICKFALL_ASSERT(false, "memory of another pool");
  return chunks_.front();
}

void Pool::putFree(Chunk& chunk, std::byte* memory, int order) {
  FreeBlock*& first = free_[std::size_t(order)];
  FreeBlock* block = new (memory) FreeBlock{first, nullptr};
  if (first) first->previous = block;
  first = block;
  chunk.freeAt[std::size_t(memory - chunk.memory) / kUnit] = std::uint8_t(order + 1);
}

void Pool::takeFree(Chunk& chunk, std::byte* memory, int order) {
  FreeBlock* block = reinterpret_cast<FreeBlock*>(memory);
  if (block->previous)
    block->previous->next = block->next;
  else
    free_[std::size_t(order)] = block->next;
  if (block->next) block->next->previous = block->previous;
  chunk.freeAt[std::size_t(memory - chunk.memory) / kUnit] = 0;
}

void* Pool::do_allocate(std::size_t bytes, [[maybe_unused]] std::size_t alignment) {
  BRICKFALL_ASSERT(alignment <= kUnit, "blocks are aligned to 64 bytes");
  int wanted = orderFor(bytes);
  std::lock_guard<std::mutex> lock(mutex_);
  int order = wanted;
  while (order < kOrders && !free_[std::size_t(order)]) order++;
  if (order == kOrders) {
    order = std::max({wanted, kSmallestChunk, orderFor(capacity_)});
    addChunk(order);
  }
  std::byte* memory = reinterpret_cast<std::byte*>(free_[std::size_t(order)]);
  Chunk& chunk = chunkOf(memory);
  takeFree(chunk, memory, order);
  while (order > wanted) {  // the upper half stays free
    order--;
    putFree(chunk, memory + (kUnit << order), order);
  }
  used_ += kUnit << wanted;
  peak_ = std::max(peak_, used_);
  return memory;
}

void Pool::do_deallocate(void* given, std::size_t bytes, std::size_t) {
  int order = orderFor(bytes);
  std::lock_guard<std::mutex> lock(mutex_);
  used_ -= kUnit << order;
  Chunk& chunk = chunkOf(given);
  std::byte* memory = static_cast<std::byte*>(given);
  while (order < chunk.order) {
    std::size_t unit = std::size_t(memory - chunk.memory) / kUnit, buddy = unit ^ (std::size_t(1) << order);
    if (chunk.freeAt[buddy] != order + 1) break;
    takeFree(chunk, chunk.memory + buddy * kUnit, order);
    memory = chunk.memory + std::min(unit, buddy) * kUnit;
    order++;
  }
  putFree(chunk, memory, order);
}

std::vector<std::string> Pool::validate() const {
  std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> wrong;
  std::size_t listed = 0, marked = 0;
  for (int order = 0; order < kOrders; order++)
    for (const FreeBlock* b = free_[std::size_t(order)]; b; b = b->next) {
      listed += kUnit << order;
      if (b->next && b->next->previous != b) wrong.push_back("a free list is torn");
    }
  for (const Chunk& chunk : chunks_)
    for (std::size_t unit = 0; unit < chunk.freeAt.size(); unit++) {
      if (chunk.freeAt[unit] == 0) continue;
      std::size_t units = std::size_t(1) << (chunk.freeAt[unit] - 1);
      marked += units * kUnit;
      if (unit % units != 0) wrong.push_back("a free block is not aligned to its size");
      bool whole = units == chunk.freeAt.size();
      if (!whole && chunk.freeAt[unit ^ units] == chunk.freeAt[unit]) wrong.push_back("two free halves are not joined");
    }
  if (listed != marked) wrong.push_back("free lists and marks differ");
  if (listed + used_ != capacity_) wrong.push_back("bytes are lost");
  return wrong;
}

}  // namespace brickfall
