#include "record/header_codec.h"

#include "record/body_codec.h"

namespace brickfall {
namespace {

constexpr std::size_t kLeastCameraBytes = 1 + 7 * 8, kCameraKeyBytes = 8 * 8;

Error bad(ErrorCode code, const std::string& what) { return {code, what}; }

std::string headerFault(const TakeHeader& header) {
  if (!(header.framesPerSecond > 0 && header.framesPerSecond <= 1e6)) {
    return "framesPerSecond is " + std::to_string(header.framesPerSecond) + ", expected a number above 0, at most 1e6";
  }
  for (const Camera& camera : header.cameras) {
    if (!withinTakeSize(camera.position) || !withinTakeSize(camera.target)) {
      return "camera \"" + camera.name + "\": position or target is not finite";
    }
    if (!(camera.fieldOfViewDegrees > 0 && camera.fieldOfViewDegrees < 180)) {
      return "camera \"" + camera.name + "\": fieldOfViewDegrees is not between 0 and 180";
    }
    std::string fault = cameraPathFault(camera.path);
    for (const CameraKey& key : camera.path)
      if (!withinTakeSize(key.position) || !withinTakeSize(key.target)) fault = "a position or target is not finite";
    if (!fault.empty()) return "camera \"" + camera.name + "\": path: " + fault;
  }
  return {};
}

std::string bodiesFault(const std::vector<TakeBody>& bodies) {
  for (std::size_t k = 0; k < bodies.size(); k++)
    if (std::string fault = bodyFault(bodies[k]); !fault.empty())
      return "body " + std::to_string(k) + " \"" + bodies[k].name + "\": " + fault;
  return {};
}

}  // namespace

Status checkHeader(const TakeHeader& header) {
  std::string fault = headerFault(header);
  return fault.empty() ? Status() : bad(ErrorCode::invalidArgument, fault);
}

Bytes encodeHeader(const TakeHeader& header) {
  ByteWriter out;
  out.text(header.scene);
  out.text(header.title);
  out.text(header.engineVersion);
  out.u64(header.seed);
  out.f64(header.framesPerSecond);
  out.varint(header.cameras.size());
  for (const Camera& camera : header.cameras) {
    out.text(camera.name);
    put(out, camera.position);
    put(out, camera.target);
    out.f64(camera.fieldOfViewDegrees);
    out.varint(camera.path.size());
    for (const CameraKey& key : camera.path) {
      out.f64(key.time);
      put(out, key.position);
      put(out, key.target);
      out.f64(key.fieldOfViewDegrees);
    }
    out.text(camera.follow);
  }
  return out.bytes();
}

namespace {

Camera getCamera(ByteReader& in, std::uint32_t version, bool& sound) {
  Camera camera;
  camera.name = in.text();
  camera.position = getVec3(in);
  camera.target = getVec3(in);
  camera.fieldOfViewDegrees = in.f64();
  std::uint64_t keys = version < kVersion3 ? 0 : in.varint();
  sound = in.canHold(keys, kCameraKeyBytes);
  for (std::uint64_t k = 0; sound && k < keys; k++) {
    CameraKey key;
    key.time = in.f64();
    key.position = getVec3(in);
    key.target = getVec3(in);
    key.fieldOfViewDegrees = in.f64();
    camera.path.push_back(key);
  }
  if (sound && version >= kVersion6) camera.follow = in.text();
  return camera;
}

}  // namespace

Result<DecodedHeader> decodeHeader(std::span<const std::uint8_t> bytes, std::uint32_t version) {
  ByteReader in(bytes);
  DecodedHeader out;
  TakeHeader& header = out.header;
  header.scene = in.text();
  header.title = in.text();
  header.engineVersion = in.text();
  header.seed = in.u64();
  header.framesPerSecond = in.f64();
  bool sound = true;
  std::uint64_t bodies = version == 1 ? in.varint() : 0;
  if (!in.canHold(bodies, kLeastBodyBytes)) {
    return bad(ErrorCode::badFormat, "header: " + std::to_string(bodies) + " bodies announced, which cannot fit");
  }
  for (std::uint64_t k = 0; sound && !in.failed() && k < bodies; k++) out.bodies.push_back(getBody(in, version, sound));
  std::uint64_t cameras = sound ? in.varint() : 0;
  sound = sound && in.canHold(cameras, kLeastCameraBytes);
  for (std::uint64_t k = 0; sound && k < cameras; k++) header.cameras.push_back(getCamera(in, version, sound));
  if (!sound || in.failed() || in.left() != 0) {
    return bad(ErrorCode::badFormat, "header: its lengths do not add up");
  }
  if (std::string fault = headerFault(header); !fault.empty()) return bad(ErrorCode::badFormat, "header: " + fault);
  if (std::string fault = bodiesFault(out.bodies); !fault.empty()) return bad(ErrorCode::badFormat, "header: " + fault);
  return out;
}

}  // namespace brickfall
