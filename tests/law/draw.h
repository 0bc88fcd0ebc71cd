// Cases at random: worlds (time step, substeps, turned, mirrored, far away) and bodies (shape, size, density).
#pragma once
#include <array>
#include <string>
#include <vector>

#include "law/lab.h"
#include "support/lab_scenes.h"

namespace brickfall::law {

class Draw {
 public:
  explicit Draw(int seed) : random_(seed * 7 + 1) {}
  double unit() { return random_.unit(); }
  double between(double a, double b) { return a + (b - a) * unit(); }
  double scale(double a, double b) { return a * std::pow(b / a, unit()); }  // even in the logarithm
  int below(int n) { return std::min(n - 1, int(unit() * n)); }
  bool oneIn(int n) { return below(n) == 0; }
  Vec3 direction() { return normalized(Vec3{between(-1, 1), between(-1, 1), between(-1, 1)}); }

  // A time step from 1/30 to 1/480 s, whole or as part of a longer one.
  LabSetup setup() {
    LabSetup s;
    double part = 1 / std::array{30.0, 60.0, 120.0, 240.0, 480.0}[std::size_t(below(5))];
    int parts = std::array{1, 1, 1, 2, 4}[std::size_t(below(5))];
    s.substeps = part * parts > 0.034 ? 1 : parts;
    s.dt = part * s.substeps;
    switch (below(5)) {
      case 0:
        break;
      case 1:
        s.turned = turn({0, 1, 0}, between(0, 360));
        break;
      case 2:
        s.turned = turn({between(-1, 1), between(-1, 1), between(-1, 1)}, between(0, 180));
        break;
      case 3:
        s.turned = turn({0, 0, 1}, 90);
        break;
      case 4:
        s.turned = turn({1, 0, 0}, 90);
        break;
    }
    s.mirrored = oneIn(3);
    int place = below(4);
    if (place < 2) s.origin = direction() * (place == 0 ? 100.0 : 1000.0);
    return s;
  }

 private:
  lab::LabRandom random_;
};

// A world drawn at random, and how long it runs.
struct DrawnWorld {
  World world;
  std::string text;  // how it was drawn
  double dt = 0;     // s
  int substeps = 1;
  int steps = 0;  // to run
  std::vector<BodyId> bodies;
};

// An upright prism of sixteen sides: a hull for a cylinder.
inline ShapeDef drumOf(double radius, double halfHeight, double density, double friction) {
  ShapeDef s = boxOf({}, density, friction);
  s.type = ShapeType::hull;
  for (int i = 0; i < 16; i++)
    for (double y : {-halfHeight, halfHeight})
      s.vertices.push_back({radius * std::cos(kPi * i / 8), y, radius * std::sin(kPi * i / 8)});
  return s;
}

// A flat body that stands firmly on its base: box, drum, or two boxes of different density.
struct FlatBody {
  BodyDef def;
  double halfHeight;
  std::string name;
};
inline FlatBody flatBody(Draw& draw, double size, double friction, double flatness = 0.4) {
  double density = draw.scale(100, 8000);
  Vec3 h{size * draw.between(.3, .5), size * draw.between(.15, .5) * flatness, size * draw.between(.3, .5)};
  FlatBody b{{}, h.y, {}};
  switch (draw.below(4)) {
    case 0:
    case 1:
      b.def = bodyOf(boxOf(h, density, friction), {});
      b.name = "box";
      break;
    case 2:
      b.def = bodyOf(drumOf(size * 0.5, h.y, density, friction), {});
      b.name = "drum";
      break;
    default:
      Vec3 part{h.x / 2, h.y, h.z};
      b.def = bodyOf(boxOf(part, density, friction), {});
      b.def.shapes.push_back(boxOf(part, density * draw.between(.7, 1.4), friction));
      b.def.shapes[0].local.position.x = -part.x;
      b.def.shapes[1].local.position.x = part.x;
      b.name = "compound";
  }
  b.name += label(" of %.3g m", size) + label(", %.0f kg/m3", density);
  return b;
}

}  // namespace brickfall::law
