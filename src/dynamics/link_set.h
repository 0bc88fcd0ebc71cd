// All that ties bodies to each other, whatever its kind: what islands are made of, what sleeps and wakes together, what goes
// when a body goes. A view of the sets that own the ties; a kind of tie is one set here.
#pragma once
#include "dynamics/contact_set.h"

namespace brickfall {

enum class LinkKind : std::uint8_t { contact, count };
//! not of the method: a count
constexpr std::size_t kLinkKinds = std::size_t(LinkKind::count);

struct Link {
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  LinkKind kind = LinkKind::contact;
  std::uint32_t index = kNoIndex;  // in the set of its kind
};

class LinkSet {
 public:
  explicit LinkSet(const ContactSet& contacts) : contacts_(contacts) {}

  // Calls visit(link), kind by kind, each in the order of its set: ties of which at least one body is awake, or moves.
  template <class Visit> void eachAwake(Visit visit) const { eachContact(contacts_.pairs, visit); }
  // And those of which none is.
  template <class Visit> void eachAsleep(Visit visit) const { eachContact(contacts_.asleep, visit); }

 private:
  template <class Visit> static void eachContact(const std::vector<CandidatePair>& pairs, Visit& visit) {
    for (const CandidatePair& pair : pairs)
      if (pair.contact != kNoIndex) visit(Link{pair.bodyA, pair.bodyB, LinkKind::contact, pair.contact});
  }
  const ContactSet& contacts_;
};

}  // namespace brickfall
