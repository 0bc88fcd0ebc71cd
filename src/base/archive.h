// Bytes in and out with one description of the layout: a function that names the fields writes or reads them. Reading
// trusts nothing: a count is checked against the bytes left before it is used, a flag is 0 or 1, a choice is one of its
// enumeration. Numbers and indices may still be anything; what they mean is for the reader of the whole to check.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace brickfall {

// Numbers, or a structure of nothing but numbers: any bits are a value of it.
template <class T> constexpr bool isPlain() {
  return std::is_same_v<T, std::byte> ||
         (std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool> && !std::is_enum_v<T> && !std::is_pointer_v<T>);
}

class WriteArchive {
 public:
  static constexpr bool kReading = false;
  template <class T> void value(const T& v) {
    static_assert(isPlain<T>());
    bytes(&v, sizeof v);
  }
  void flag(bool v) { value(std::uint8_t(v)); }
  template <class E> void choice(E v, E) { value(std::uint8_t(v)); }
  template <class T, class A> void list(const std::vector<T, A>& v) {
    static_assert(isPlain<T>());
    value(std::uint64_t(v.size()));
    bytes(v.data(), v.size() * sizeof(T));
  }
  std::uint64_t count(std::uint64_t n, std::size_t) {
    value(n);
    return n;
  }
  bool failed() const { return false; }
  std::vector<std::byte> take() { return std::move(out_); }

 private:
  void bytes(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::byte* from = static_cast<const std::byte*>(data);
    out_.insert(out_.end(), from, from + size);
  }
  std::vector<std::byte> out_;
};

class ReadArchive {
 public:
  static constexpr bool kReading = true;
  explicit ReadArchive(std::span<const std::byte> in) : in_(in) {}
  template <class T> void value(T& v) {
    static_assert(isPlain<T>());
    if (!need(sizeof v)) return;
    std::memcpy(static_cast<void*>(&v), in_.data() + at_, sizeof v);
    at_ += sizeof v;
  }
  void flag(bool& v) {
    std::uint8_t byte = 0;
    value(byte);
    if (byte > 1) failed_ = true;
    v = byte == 1;
  }
  template <class E> void choice(E& v, E last) {
    std::uint8_t byte = 0;
    value(byte);
    if (byte > std::uint8_t(last)) failed_ = true;
    if (!failed_) v = E(byte);
  }
  template <class T, class A> void list(std::vector<T, A>& v) {
    static_assert(isPlain<T>());
    std::uint64_t n = count(0, sizeof(T));
    if (failed_) return;
    v.resize(std::size_t(n));
    if (n > 0) std::memcpy(static_cast<void*>(v.data()), in_.data() + at_, std::size_t(n) * sizeof(T));
    at_ += std::size_t(n) * sizeof(T);
  }
  // A count of items of at least `itemSize` bytes each.
  std::uint64_t count(std::uint64_t, std::size_t itemSize) {
    std::uint64_t n = 0;
    value(n);
    if (!failed_ && n > (in_.size() - at_) / itemSize) failed_ = true;
    return failed_ ? 0 : n;
  }
  bool failed() const { return failed_; }
  bool atEnd() const { return at_ == in_.size(); }

 private:
  bool need(std::size_t size) {
    if (failed_ || in_.size() - at_ < size) failed_ = true;
    return !failed_;
  }
  std::span<const std::byte> in_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace brickfall
