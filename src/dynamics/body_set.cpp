#include "dynamics/body_set.h"

#include <algorithm>

namespace brickfall {

BodyIndex BodySet::create() {
  BodyIndex body;
  if (free_.empty()) {
    body = BodyIndex(data.size());
    motion.emplace_back();
    mass.emplace_back();
    data.emplace_back();
    shapes.emplace_back();
    still.push_back(0);
  } else {
    body = free_.back();
    free_.pop_back();
    motion[body] = {};
    mass[body] = {};
    std::uint16_t generation = data[body].generation;
    data[body] = {};
    data[body].generation = generation;
    shapes[body].clear();
    still[body] = 0;
  }
  data[body].alive = true;
  data[body].generation++;
  if (data[body].generation == 0) data[body].generation = 1;
  data[body].order = nextOrder_++;
  count_++;
  return body;
}

void BodySet::destroy(BodyIndex body) {
  data[body].alive = false;
  shapes[body].clear();
  // A generation that begins anew would make ids of long ago valid again: such a slot is never used again.
  if (data[body].generation < 0xffff) free_.push_back(body);
  count_--;
}

std::vector<BodyIndex> BodySet::inOrder() const {
  std::vector<BodyIndex> out;
  out.reserve(std::size_t(count_));
  for (BodyIndex i = 0; i < data.size(); i++)
    if (data[i].alive) out.push_back(i);
  if (free_.empty() && nextOrder_ == data.size() + 1) return out;  // slots never used again: already in order
  std::sort(out.begin(), out.end(), [&](BodyIndex a, BodyIndex b) { return data[a].order < data[b].order; });
  return out;
}

}  // namespace brickfall
