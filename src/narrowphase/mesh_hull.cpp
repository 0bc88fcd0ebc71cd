// Box or hull on a face: separating axes, of which only those may become a contact's normal along which the surface pushes
// (MeshFace): the face's own, those of the shape's faces that a corner of the surface meets, and those across two edges.
// All others still tell whether the two are apart, and whether the overlap that is seen is another face's business.
#include "narrowphase/clipping.h"
#include "narrowphase/features.h"
#include "narrowphase/hull_view.h"
#include "narrowphase/mesh_collide.h"
#include "narrowphase/segment.h"

namespace brickfall {

namespace {

constexpr double kParallel2 = 1e-8;
constexpr double kSameDirection = 0.98;
constexpr double kAlongFace = 0.9;  // cosine between an edge contact's normal and a face on which the edge may lie
constexpr int kMaxPolygon = kMaxHullVertices + 8;

struct Corner {
  Vec3 p;
  std::uint32_t feature;
};

// Which axis the contact has. Separations along the axis, negative: overlap.
struct Choice {
  enum Kind { surface, shapeFace, edges } kind = surface;
  double separation = 0;
  int face = -1;  // of the shape
  int edge = -1;  // of the triangle
  MeshContactPoint point;
};

// Keeps what is not above the plane by more than slack.
int cut(const Corner* from, int count, Corner* to, Vec3 outward, double offset, double slack, std::uint32_t name) {
  int kept = 0;
  for (int i = 0; i < count && kept < kMaxPolygon - 1; i++) {
    const Corner &c = from[i], &next = from[i + 1 == count ? 0 : i + 1];
    double dc = dot(outward, c.p) - offset, dn = dot(outward, next.p) - offset;
    bool inside = dc <= slack, nextInside = dn <= slack;
    if (inside) to[kept++] = c;
    if (inside == nextInside) continue;
    double f = dc / (dc - dn);
    f = f < 0 ? 0 : f > 1 ? 1 : f;
    std::uint32_t low = c.feature < next.feature ? c.feature : next.feature;
    to[kept++] = {c.p + (next.p - c.p) * f, 0x30000000u | ((low * 2654435761u ^ name * 40503u) & 0x0fffffffu)};
  }
  return kept;
}

// The shape's face that looks at the surface most, cut to the triangle.
void addSurfaceContact(const MeshFace& face, const HullView& hull, int deepest, double margin, double slack,
                       std::vector<MeshContactPoint>& out) {
  Corner one[kMaxPolygon], other[kMaxPolygon];
  Corner *from = one, *to = other;
  int count = 0, incident = faceAround(hull, deepest, -face.normal()), e = hull.firstEdge[incident];
  do {
    one[count++] = {hull.vertices[hull.edges[e].origin], cornerOfB(hull.edges[e].origin)};
    e = hull.edges[e].next;
  } while (e != hull.firstEdge[incident]);
  for (int k = 0; k < 3 && count > 0; k++) {
    count = cut(from, count, to, face.outward(k), dot(face.outward(k), face.corner(k)), slack, face.name(k));
    Corner* swap = from;
    from = to, to = swap;
  }
  for (int i = 0; i < count; i++) {
    double height = face.height(from[i].p);
    if (height <= margin)
      out.push_back({face.normal(), from[i].p - face.normal() * height, from[i].p, height, from[i].feature});
  }
}

// The triangle, cut to the sides of one of the shape's faces.
void addShapeFaceContact(const MeshFace& face, const HullView& hull, int reference, double margin, double slack,
                         std::vector<MeshContactPoint>& out) {
  Corner one[kMaxPolygon], other[kMaxPolygon];
  Corner *from = one, *to = other;
  int count = 0;
  for (int k = 0; k < 3; k++) one[count++] = {face.corner(k), cornerOfA(int(face.name(k) & 0x0fffffff))};
  const HullPlane& plane = hull.planes[reference];
  int e = hull.firstEdge[reference];
  do {
    Vec3 a = hull.vertices[hull.edges[e].origin], b = hull.vertices[hull.edges[hull.edges[e].next].origin];
    Vec3 outward = normalized(cross(b - a, plane.normal));
    count = cut(from, count, to, outward, dot(outward, a), slack, std::uint32_t(e));
    Corner* swap = from;
    from = to, to = swap;
    e = hull.edges[e].next;
  } while (e != hull.firstEdge[reference] && count > 0);
  for (int i = 0; i < count; i++) {
    double height = dot(plane.normal, from[i].p) - plane.offset;
    if (height <= margin)
      out.push_back({-plane.normal, from[i].p, from[i].p - plane.normal * height, height, from[i].feature});
  }
}

// Two edges that cross: one point. But where an edge of the mesh runs along a face of the shape, as a ridge under a box, it
// crosses that face's outline twice, and either crossing may be the better axis: both ends of what lies on the face are
// points, else the shape would rock over from one to the other.
void addEdgeContact(const MeshFace& face, const HullView& hull, const Choice& choice, double margin, double slack,
                    std::vector<MeshContactPoint>& out) {
  Vec3 start = face.corner(choice.edge), along = face.edge(choice.edge), normal = choice.point.normal;
  const HullPlane& plane = hull.planes[choice.face];
  double alike = -dot(plane.normal, normal), from = 0, to = 1;
  int e = hull.firstEdge[choice.face];
  do {
    Vec3 a = hull.vertices[hull.edges[e].origin], b = hull.vertices[hull.edges[hull.edges[e].next].origin];
    Vec3 outward = normalized(cross(b - a, plane.normal));
    double height = dot(outward, start - a) - slack, slope = dot(outward, along);
    if (slope > 0 && -height < to * slope) to = -height / slope;
    if (slope < 0 && -height < from * slope) from = -height / slope;
    if (slope == 0 && height > 0) to = -1;
    e = hull.edges[e].next;
  } while (e != hull.firstEdge[choice.face]);
  if (!(alike > kAlongFace && from < to)) {
    out.push_back(choice.point);
    return;
  }
  for (double t : {from, to}) {
    Vec3 p = start + along * t;
    double separation = (dot(plane.normal, p) - plane.offset) / alike;
    std::uint32_t feature = 0x10000000u | (choice.point.feature + (t == to ? 1 : 0));
    if (separation <= margin) out.push_back({normal, p, p + normal * separation, separation, feature});
  }
}

class FaceAxes {
 public:
  FaceAxes(const MeshFace& face, const HullView& hull, double margin, const ContactTolerances& tolerance)
      : face_(face), hull_(hull), margin_(margin), tolerance_(tolerance) {}

  // False: they are further apart than the margin.
  bool search() {
    deepest = supportVertex(hull_, -face_.normal());
    best.separation = most = face_.height(hull_.vertices[deepest]);
    if (!(most <= margin_)) return false;
    for (int f = 0; f < hull_.faceCount; f++)
      if (!tryShapeFace(f)) return false;
    for (int k = 0; k < 3; k++)
      if (!tryEdges(k)) return false;
    return true;
  }

  Choice best;
  double most = 0;  // largest separation of any axis, allowed or not
  int deepest = 0;  // corner of the shape, along the face's normal

 private:
  void see(double separation) { most = separation > most ? separation : most; }

  bool tryShapeFace(int f) {
    const HullPlane& plane = hull_.planes[f];
    int lowest = 0;
    double least = dot(plane.normal, face_.corner(0));
    for (int k = 1; k < 3; k++) {
      double along = dot(plane.normal, face_.corner(k));
      if (along < least) least = along, lowest = k;
    }
    double separation = least - plane.offset;
    if (!(separation <= margin_)) return false;
    see(separation);
    double alike = -dot(plane.normal, face_.normal());
    double bias = alike > kSameDirection ? tolerance_.otherFace : tolerance_.face;
    if (separation > best.separation + bias && face_.cornerPushes(lowest, -plane.normal))
      best.kind = Choice::shapeFace, best.separation = separation, best.face = f;
    return true;
  }

  // Axes across edge k of the triangle and edges of the shape. The triangle's normals at the edge are a half circle from front
  // to back; a shape's are the arc between its two faces.
  bool tryEdges(int k) {
    Vec3 a = face_.corner(k), e = face_.edge(k);
    double ee = lengthSquared(e);
    double side[kMaxHullFaces];
    for (int f = 0; f < hull_.faceCount; f++) side[f] = dot(hull_.planes[f].normal, e);
    for (int h = 0; h < hull_.edgeCount; h += 2) {
      int f1 = hull_.edges[h].face, f2 = hull_.edges[h + 1].face;
      if (!(side[f1] * side[f2] < 0)) continue;
      Vec3 b = hull_.vertices[hull_.edges[h].origin], d = hull_.vertices[hull_.edges[h + 1].origin] - b;
      Vec3 axis = cross(e, d);
      double length2 = lengthSquared(axis);
      if (length2 < kParallel2 * ee * lengthSquared(d)) continue;
      axis *= 1 / std::sqrt(length2);
      if (dot(axis, hull_.planes[f1].normal + hull_.planes[f2].normal) > 0) axis = -axis;  // towards the shape
      if (!(dot(axis, face_.outward(k)) > 0)) continue;
      double separation = dot(axis, b - a);
      if (!(separation <= margin_)) return false;
      see(separation);
      if (!(separation > best.separation + tolerance_.edge) || !face_.edgePushes(k, axis)) continue;
      SegmentPair pair = nearestOfSegments(a, e, b, d);
      if (pair.s <= 0 || pair.s >= 1 || pair.t <= 0 || pair.t >= 1) continue;
      best.kind = Choice::edges, best.separation = separation, best.edge = k;
      best.face = dot(axis, hull_.planes[f1].normal) < dot(axis, hull_.planes[f2].normal) ? f1 : f2;
      best.point = {axis, pair.p, pair.p + axis * separation, separation,
                    0x10000000u | ((face_.name(k) * 2654435761u ^ std::uint32_t(h)) & 0x0fffffffu)};
    }
    return true;
  }

  const MeshFace& face_;
  const HullView& hull_;
  double margin_;
  const ContactTolerances& tolerance_;
};

}  // namespace

void collideFaceHull(const MeshFace& face, const HullView& hull, double margin, std::vector<MeshContactPoint>& out) {
  if (!(face.height(hull.centroid) > 0)) return;
  ContactTolerances tolerance = contactTolerances(hull.innerRadius);
  FaceAxes axes(face, hull, margin, tolerance);
  if (!axes.search()) return;
  // A way out that the surface does not allow here is much shorter than the one it does: the shape overlaps the neighbour
  // beyond the edge, and that one pushes.
  if (axes.best.separation < 0 && axes.most > axes.best.separation + hull.innerRadius * 0.1 &&
      axes.most > 0.5 * axes.best.separation)
    return;
  if (axes.best.kind == Choice::edges) {
    addEdgeContact(face, hull, axes.best, margin, tolerance.slack, out);
  } else if (axes.best.kind == Choice::shapeFace) {
    addShapeFaceContact(face, hull, axes.best.face, margin, tolerance.slack, out);
  } else {
    addSurfaceContact(face, hull, axes.deepest, margin, tolerance.slack, out);
  }
}

}  // namespace brickfall
