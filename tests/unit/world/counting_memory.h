// Memory of a program that counts what a world takes of it.
#pragma once
#include <cstddef>
#include <memory_resource>

namespace brickfall {

class CountingMemory final : public std::pmr::memory_resource {
 public:
  std::size_t held = 0, taken = 0;

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    held += bytes;
    taken += bytes;
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    held -= bytes;
    std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace brickfall
