#include "viewer_core/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "brickfall/scene.h"
#include "viewer_core/settings_table.h"

namespace brickfall::viewer {

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out + "\"";
}

std::string listOf(Vec3 v) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z); }

// About the world's x, then y, then z axis.
Vec3 degreesOf(const Quat& rotation) {
  const Vec3 x = rotate(rotation, Vec3{1, 0, 0}), y = rotate(rotation, Vec3{0, 1, 0}),
             z = rotate(rotation, Vec3{0, 0, 1});
  const double aboutY = std::asin(std::clamp(-x.z, -1.0, 1.0));
  if (std::fabs(x.z) > 1 - 1e-12) return Vec3{std::atan2(-z.y, y.y), aboutY, 0} * kDegrees;
  return Vec3{std::atan2(y.z, z.z), aboutY, std::atan2(x.y, x.x)} * kDegrees;
}

bool turned(const Quat& rotation) { return length(degreesOf(rotation)) > 1e-9; }

// False: a scene file has no such shape.
bool addShape(std::string& out, const ShapeDef& shape) {
  switch (shape.type) {
    case ShapeType::box:
      out += "size = " + listOf(shape.halfExtents * 2.0) + "\n";
      return true;
    case ShapeType::sphere:
      out += fmt::format("shape = \"sphere\"\nradius = {:.9g}\n", shape.radius);
      return true;
    case ShapeType::capsule:
    case ShapeType::cylinder:
      out += fmt::format("shape = \"{}\"\nradius = {:.9g}\nheight = {:.9g}\n",
                         shape.type == ShapeType::capsule ? "capsule" : "cylinder", shape.radius, 2 * shape.halfHeight);
      return true;
    case ShapeType::cone:
      out += fmt::format("shape = \"cone\"\nradius = {:.9g}\ntop_radius = {:.9g}\nheight = {:.9g}\n", shape.radius,
                         shape.topRadius, 2 * shape.halfHeight);
      return true;
    case ShapeType::hull:
      out += "shape = \"hull\"\nvertices = [";
      for (std::size_t i = 0; i < shape.vertices.size(); i++) out += (i > 0 ? ", " : "") + listOf(shape.vertices[i]);
      out += "]\n";
      return true;
    default:
      return false;
  }
}

bool addBody(std::string& out, const ListedBody& listed, const FrameBody& body, std::string name) {
  const bool moves = listed.mass > 0;
  std::string text = "\n[[body]]\nname = " + quoted(name) + "\n";
  if (!moves) text += "type = \"fixed\"\n";
  if (!listed.material.empty()) text += "material = " + quoted(listed.material) + "\n";
  text += "position = " + listOf(body.pose.position) + "\n";
  if (turned(body.pose.rotation)) text += "rotation_degrees = " + listOf(degreesOf(body.pose.rotation)) + "\n";
  if (moves && length(body.linearVelocity) > 0) text += "velocity = " + listOf(body.linearVelocity) + "\n";
  if (moves && length(body.angularVelocity) > 0) text += "angular_velocity = " + listOf(body.angularVelocity) + "\n";
  const bool alone = listed.shapes.size() == 1 && length(listed.shapes[0].local.position) == 0 &&
                     !turned(listed.shapes[0].local.rotation);
  for (const ShapeDef& shape : listed.shapes) {
    if (!alone) {
      text += "[[body.part]]\nposition = " + listOf(shape.local.position) + "\n";
      if (turned(shape.local.rotation)) text += "rotation_degrees = " + listOf(degreesOf(shape.local.rotation)) + "\n";
    }
    if (!addShape(text, shape)) return false;
  }
  if (listed.shapes.empty()) return false;
  out += text;
  return true;
}

void addHead(std::string& out, const Frame& frame) {
  const auto setting = [&](std::string_view key, double usual) {
    const auto rows = settingRows();
    for (std::size_t i = 0; i < rows.size() && i < frame.settings.size(); i++)
      if (rows[i].key == key) return frame.settings[i];
    return usual;
  };
  const RunInfo& info = *frame.info;
  out += "title = " +
         quoted(fmt::format("{} at {:.3f} s", info.title.empty() ? info.name : info.title, frame.status.time));
  out += "\n\n[world]\n";
  out += "gravity = " + listOf({setting("gravity.x", 0), setting("gravity.y", -9.81), setting("gravity.z", 0)}) + "\n";
  out += fmt::format("time_step = {:.12g}\nsubsteps = {:.0f}\nseconds = {:.9g}\n", setting("timeStep", 1.0 / 60),
                     setting("substeps", 1), info.seconds > 0 ? info.seconds : 10);
  for (const MaterialRow& m : frame.materials)
    out += fmt::format(
        "\n[[material]]\nname = {}\ndensity = {:.9g}\nfriction = {:.9g}\nrestitution = {:.9g}\n"
        "rolling_resistance = {:.9g}\ncolour = \"#{:06X}\"\n",
        quoted(m.name), m.density, m.friction, m.restitution, m.rollingResistance, m.colour);
}

void addCamera(std::string& out, const Camera& camera) {
  out += fmt::format("\n[[camera]]\nname = {}\nposition = {}\ntarget = {}\nfield_of_view_degrees = {:.6g}\n",
                     quoted(camera.name), listOf(camera.position), listOf(camera.target), camera.fieldOfViewDegrees);
}

}  // namespace

SceneText sceneTextOf(const Frame& frame, const Camera& view) {
  SceneText out;
  addHead(out.text, frame);
  addCamera(out.text, view);
  std::map<std::string, int> named;
  bool ground = false;
  int lost = 0;
  std::string bodies;
  for (std::size_t i = 0; i < frame.bodies.size(); i++) {
    const ListedBody& body = frame.list->bodies[i];
    const FrameBody& state = frame.bodies[i];
    const bool plane = body.shapes.size() == 1 && body.shapes[0].type == ShapeType::plane;
    if (plane && !ground) {
      ground = true;
      const Vec3 up = rotate(state.pose.rotation, Vec3{0, 1, 0});
      const Vec3 axis = cross(Vec3{0, 1, 0}, up);
      out.text += fmt::format("\n[ground]\nheight = {:.9g}\n", state.pose.position.y);
      if (length(axis) > 1e-9)
        out.text += fmt::format("tilt_degrees = {:.9g}\ntilt_axis = {}\n", std::atan2(length(axis), up.y) * kDegrees,
                                listOf(axis * (1 / length(axis))));
      if (!body.material.empty()) out.text += "material = " + quoted(body.material) + "\n";
      continue;
    }
    const int times = named[body.name]++;
    lost += !addBody(bodies, body, state, times == 0 ? body.name : fmt::format("{} {}", body.name, times + 1));
  }
  if (!ground) out.text += "\n[ground]\nenabled = false\n";
  out.text += bodies;
  if (lost > 0) out.leftOut = fmt::format("{} bodies that a scene file cannot hold", lost);
  return out;
}

}  // namespace brickfall::viewer
