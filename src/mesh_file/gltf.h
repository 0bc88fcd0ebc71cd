// A glTF file while it is read: its JSON, its buffers, and the first error. Nothing in the JSON is trusted: every field is looked
// at through the functions here, which find out what is missing or of the wrong kind and name it.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "brickfall/mesh_file.h"

namespace brickfall::gltf {

using Json = nlohmann::json;

class Document {
 public:
  explicit Document(const std::string& name) : name_(name) {}

  bool failed() const { return !message_.empty(); }
  // The first one stays.
  void fail(const std::string& field, const std::string& what) {
    if (!failed()) message_ = name_ + ": " + field + ": " + what;
  }
  Error error() const { return {ErrorCode::badFormat, message_}; }

  // The item of a top-level array, or null with an error. `at` is the field that named it.
  const Json* item(const char* list, std::size_t index, const std::string& at);
  // A whole number in 0 .. most; absent: `fallback`, or an error if there is none.
  std::size_t whole(const Json& object, const char* key, const std::string& at, std::optional<std::size_t> fallback,
                    std::size_t most);
  // Up to sixteen finite numbers; false if absent. A wrong one is an error.
  bool numbers(const Json& object, const char* key, const std::string& at, std::size_t count, double* out);

  Json json;
  std::vector<std::vector<std::byte>> buffers;

 private:
  std::string name_;
  std::string message_;
};

std::string at(const char* list, std::size_t index);

// gltf_buffers.cpp: splits a .glb, parses the JSON, brings in all buffers.
bool open(Document& document, std::span<const std::byte> bytes, const MeshFileOpener& opener);

// gltf_accessor.cpp
std::vector<Vec3> positions(Document& document, std::size_t accessor, const std::string& at);
std::vector<std::uint32_t> wholeNumbers(Document& document, std::size_t accessor, const std::string& at);

}  // namespace brickfall::gltf
