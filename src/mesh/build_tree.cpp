// Building the tree from the root down. A box's axes are the principal axes of the triangles' surface inside it (their
// second moments, weighted by area: inner vertices and fine tessellation of one part do not turn it). Faces are parted at the
// mean of their middles along the longest axis; where that leaves hardly any on one side, at the median, which bounds the
// height.
#include <algorithm>
#include <string>

#include "brickfall/geometry/mesh_tree.h"
#include "math/symmetric_eigen.h"

namespace brickfall {

namespace {

constexpr double kPad = 1e-6;  // of a box's size: rounding of its axes, centre and halves to single precision

struct Item {
  Triangle triangle;  // about the middle of the mesh
  double area;
  std::uint32_t face;

  Vec3 sum() const { return triangle.corner[0] + triangle.corner[1] + triangle.corner[2]; }
};

// Sums of x x^T as six numbers.
struct Moments {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  void add(Vec3 v, double weight) {
    Vec3 w = v * weight;
    xx += w.x * v.x, yy += w.y * v.y, zz += w.z * v.z;
    xy += w.x * v.y, xz += w.x * v.z, yz += w.y * v.z;
  }
  Mat3 matrix() const { return {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}}; }
};

// Axes of one triangle: its longest edge, across it, and its normal.
Mat3 axesOf(const Triangle& t) {
  Vec3 e[3] = {t.corner[1] - t.corner[0], t.corner[2] - t.corner[1], t.corner[0] - t.corner[2]};
  int longest = lengthSquared(e[1]) > lengthSquared(e[0]) ? 1 : 0;
  if (lengthSquared(e[2]) > lengthSquared(e[longest])) longest = 2;
  Vec3 u = normalized(e[longest]), n = normalized(cross(e[0], e[1]));
  return {{u, cross(n, u), n}};
}

// The second moment of a triangle's surface about the origin is area / 12 (s s^T + sum of p p^T), s the sum of its corners.
Mat3 axesOf(const Item* items, std::size_t count) {
  if (count == 1) return axesOf(items[0].triangle);
  double area = 0;
  Vec3 first;
  Vec3 about = items[0].triangle.corner[0];  // so that a small part far out loses no digits
  Moments moments;
  for (std::size_t i = 0; i < count; i++) {
    const Item& item = items[i];
    Vec3 p = item.triangle.corner[0] - about, q = item.triangle.corner[1] - about, r = item.triangle.corner[2] - about;
    Vec3 s = p + q + r;
    area += item.area;
    first += s * (item.area / 3);
    double weight = item.area / 12;
    moments.add(s, weight);
    moments.add(p, weight);
    moments.add(q, weight);
    moments.add(r, weight);
  }
  moments.add(first, -1 / area);
  Mat3 covariance = moments.matrix();
  double scale = covariance.row[0].x + covariance.row[1].y + covariance.row[2].z;
  return scale > 0 ? symmetricEigen(covariance * (1 / scale)).axes : Mat3{};
}

class Builder {
 public:
  Builder(std::vector<Item>& items, std::vector<MeshTree::Node>& nodes) : items_(items), nodes_(nodes) {}

  int build() {
    nodes_.reserve(2 * items_.size());
    nodes_.emplace_back();
    struct Task {
      std::size_t node, begin, end;
      int depth;
    };
    std::vector<Task> tasks = {{0, 0, items_.size(), 1}};
    int height = 0;
    while (!tasks.empty()) {
      Task task = tasks.back();
      tasks.pop_back();
      height = std::max(height, task.depth);
      Vec3 longestAxis = fit(nodes_[task.node], task.begin, task.end);
      if (task.end - task.begin == 1) {
        nodes_[task.node].child = ~std::int32_t(task.begin);
        continue;
      }
      std::size_t middle = part(task.begin, task.end, longestAxis);
      std::size_t child = nodes_.size();
      nodes_[task.node].child = std::int32_t(child);
      nodes_.emplace_back();
      nodes_.emplace_back();
      tasks.push_back({child + 1, middle, task.end, task.depth + 1});
      tasks.push_back({child, task.begin, middle, task.depth + 1});
    }
    return height;
  }

 private:
  // Smallest box along the axes of the surface; gives its longest axis.
  Vec3 fit(MeshTree::Node& node, std::size_t begin, std::size_t end) const {
    Mat3 axes = axesOf(items_.data() + begin, end - begin);
    for (int k = 0; k < 3; k++) {
      node.x[k] = float(axes.row[k].x), node.y[k] = float(axes.row[k].y), node.z[k] = float(axes.row[k].z);
      axes.row[k] = {node.x[k], node.y[k], node.z[k]};
    }
    Vec3 lower{1e300, 1e300, 1e300}, upper = -lower;
    for (std::size_t i = begin; i < end; i++)
      for (Vec3 p : items_[i].triangle.corner) {
        Vec3 along = axes * p;
        lower = min(lower, along), upper = max(upper, along);
      }
    Vec3 centre = transposeTimes(axes, (lower + upper) * 0.5);
    node.x[3] = float(centre.x), node.y[3] = float(centre.y), node.z[3] = float(centre.z);
    Vec3 about = axes * Vec3{node.x[3], node.y[3], node.z[3]};
    Vec3 half = max(upper - about, about - lower);
    double pad = kPad * (half.x + half.y + half.z);
    int longest = 0;
    for (int k = 0; k < 3; k++) {
      node.half[k] = float(half[k] + pad);
      if (half[k] > half[longest]) longest = k;
    }
    return axes.row[longest];
  }

  std::size_t part(std::size_t begin, std::size_t end, Vec3 axis) {
    Vec3 all;
    for (std::size_t i = begin; i < end; i++) all += items_[i].sum();
    double mean = dot(axis, all) / double(end - begin);
    std::size_t low = begin, high = end;
    while (low < high) {
      if (dot(axis, items_[low].sum()) < mean)
        low++;
      else
        std::swap(items_[low], items_[--high]);
    }
    std::size_t least = (end - begin) / 8 + 1;
    if (low - begin >= least && end - low >= least) return low;
    if (end - begin == 2) return begin + 1;
    std::sort(items_.begin() + std::ptrdiff_t(begin), items_.begin() + std::ptrdiff_t(end),
              [&](const Item& a, const Item& b) {
                double x = dot(axis, a.sum()), y = dot(axis, b.sum());
                return x != y ? x < y : a.face < b.face;
              });
    return begin + (end - begin) / 2;
  }

  std::vector<Item>& items_;
  std::vector<MeshTree::Node>& nodes_;
};

}  // namespace

MeshTree MeshTree::build(TriangleMesh mesh) {
  MeshTree tree(std::move(mesh));
  const TriangleMesh& m = tree.mesh_;
  tree.middle_ = (m.bounds().lower + m.bounds().upper) * 0.5;
  tree.radius_ = length(m.bounds().upper - m.bounds().lower) * 0.5;
  std::vector<Item> items(m.count());
  for (std::uint32_t f = 0; f < items.size(); f++) {
    Triangle t = m.triangle(f);
    for (Vec3& p : t.corner) p -= tree.middle_;
    items[f] = {t, 0.5 * length(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0])), f};
  }
  tree.height_ = Builder(items, tree.nodes_).build();
  tree.triangles_.reserve(items.size());
  tree.order_.reserve(items.size());
  for (const Item& item : items) {
    tree.triangles_.push_back(m.triangle(item.face));
    tree.order_.push_back(item.face);
  }
  return tree;
}

Obb MeshTree::box(int index) const {
  const Node& n = nodes_[std::size_t(index)];
  Obb box;
  box.centre = middle_ + Vec3{n.x[3], n.y[3], n.z[3]};
  for (int k = 0; k < 3; k++) {
    box.axes.row[k] = {n.x[k], n.y[k], n.z[k]};
    box.halfExtents[k] = n.half[k];
  }
  return box;
}

std::string MeshTree::validate() const {
  if (nodes_.size() != 2 * mesh_.count() - 1) return "not one leaf a triangle";
  std::vector<int> seen(mesh_.count()), parents(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); i++) {
    if (nodes_[i].child < 0) {
      std::size_t leaf = std::size_t(~nodes_[i].child);
      if (leaf >= order_.size() || order_[leaf] >= seen.size() || seen[order_[leaf]]++)
        return "a face is lost or twice";
    } else {
      std::size_t child = std::size_t(nodes_[i].child);
      if (child <= i || child + 1 >= nodes_.size()) return "a child is not there";
      parents[child]++, parents[child + 1]++;
    }
  }
  for (std::size_t i = 1; i < parents.size(); i++)
    if (parents[i] != 1) return "a box has not one parent";
  // Every box holds the triangles of all leaves below it.
  for (std::size_t i = 0; i < nodes_.size(); i++) {
    std::vector<std::int32_t> below = {std::int32_t(i)};
    Obb outer = box(int(i));
    while (!below.empty()) {
      const Node& n = nodes_[std::size_t(below.back())];
      below.pop_back();
      if (n.child >= 0) {
        below.push_back(n.child);
        below.push_back(n.child + 1);
        continue;
      }
      for (Vec3 p : triangles_[std::size_t(~n.child)].corner) {
        Vec3 local = abs(outer.axes * (p - outer.centre));
        for (int k = 0; k < 3; k++)
          if (!(local[k] <= outer.halfExtents[k])) return "a box does not hold its triangles";
      }
    }
  }
  return {};
}

}  // namespace brickfall
