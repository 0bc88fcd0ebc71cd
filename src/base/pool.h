// Memory for what lives for one step, or as long as an island: a buddy allocator that gives back to itself and never to the
// system, so that a step in which islands merge and part takes nothing from the heap.
//
//   one chunk:  [ 64 | 64 |   128   |        256        |                  512                  ]
//
// A block has 64 x 2^k bytes. Two free neighbours that were once one block become one again, so memory given back by many
// small islands serves a large one: free lists by size (as std::pmr's pools have them) would keep it for small ones only.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <string>
#include <vector>

namespace brickfall {

// May be used by several threads at once.
class Pool final : public std::pmr::memory_resource {
 public:
  Pool() = default;
  ~Pool() override;
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  // Where chunks come from; null: operator new. Before the first of them.
  void takeFrom(std::pmr::memory_resource* upstream) { upstream_ = upstream; }
  // Takes from the system what is missing to a capacity of `bytes`.
  void reserve(std::size_t bytes);
  std::size_t capacity() const { return capacity_; }
  std::size_t used() const { return used_; }  // bytes of blocks handed out
  std::size_t peak() const { return peak_; }  // the most that was ever in use at once
  std::vector<std::string> validate() const;  // empty = all invariants hold

 private:
  static constexpr std::size_t kUnit = 64;  // bytes, also the alignment
  static constexpr int kOrders = 40;
  struct FreeBlock {
    FreeBlock *next, *previous;
  };
  struct Chunk {
    std::byte* memory;
    int order;                         // the chunk has kUnit << order bytes
    std::vector<std::uint8_t> freeAt;  // by unit: order + 1 of the free block that begins there, else 0
  };

  static int orderFor(std::size_t bytes);
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
  void addChunk(int order);
  Chunk& chunkOf(const void* memory);
  void putFree(Chunk& chunk, std::byte* memory, int order);
  void takeFree(Chunk& chunk, std::byte* memory, int order);

  mutable std::mutex mutex_;
  std::vector<Chunk> chunks_;
  std::array<FreeBlock*, kOrders> free_{};
  std::pmr::memory_resource* upstream_ = nullptr;
  std::size_t capacity_ = 0, used_ = 0, peak_ = 0;
};

}  // namespace brickfall
