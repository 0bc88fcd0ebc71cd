#include "dynamics/contact_set.h"

#include <algorithm>

namespace brickfall {

ContactIndex ContactSet::create() {
  changed = true;
  if (!free_.empty()) {
    ContactIndex contact = free_.back();
    free_.pop_back();
    contacts[contact] = {};
    geometry[contact] = {};
    return contact;
  }
  contacts.emplace_back();
  geometry.emplace_back();
  return ContactIndex(contacts.size() - 1);
}

void ContactSet::destroy(ContactIndex contact) {
  changed = true;
  contacts[contact].count = 0;
  touchingChanged = touchingChanged || contacts[contact].touching;
  contacts[contact].touching = false;
  contacts[contact].bodyA = kNoIndex;
  free_.push_back(contact);
}

void ContactSet::insert(const std::vector<CandidatePair>& found) {
  if (found.empty()) return;
  std::size_t known = pairs.size();
  for (const CandidatePair& pair : found) {
    auto place = std::lower_bound(pairs.begin(), pairs.begin() + std::ptrdiff_t(known), pair);
    bool have =
        place != pairs.begin() + std::ptrdiff_t(known) && place->shapeA == pair.shapeA && place->shapeB == pair.shapeB;
    if (!have) pairs.push_back(pair);
  }
  std::inplace_merge(pairs.begin(), pairs.begin() + std::ptrdiff_t(known), pairs.end());
}

}  // namespace brickfall
