// All mortar joints of a world. Broken ones stay in their slots, and tie nothing.
#pragma once
#include <array>
#include <map>
#include <vector>

#include "dynamics/lasting_ties.h"
#include "dynamics/mortar.h"
#include "dynamics/mortar_past.h"

namespace brickfall {

class MortarSet : public LastingTies<Mortar, LinkKind::mortar> {
 public:
  MortarIndex create(const Mortar& mortar, const SharedStrength& shared, std::uint64_t userData);
  std::uint64_t userDataOf(MortarIndex mortar) const { return mortar < userData_.size() ? userData_[mortar] : 0; }
  // The joint has broken: it ties nothing from now on.
  void breakUp(MortarIndex mortar);
  // It has crushed. What is left of it lies between its bodies, and bears pressure and rubs until it opens.
  void crush(MortarIndex mortar);
  void destroy(MortarIndex mortar);
  // How the joint opened; null: it has not cracked.
  OpeningMemory* pastOf(MortarIndex mortar);
  const OpeningMemory* pastOf(MortarIndex mortar) const;
  void addPasts(std::vector<OpeningMemory>&& fresh);

  // --- functions of every kind of tie (contact_set.h)
  void dropOf(BodyIndex body);
  void displace(BodyIndex) {}  // a body that is put elsewhere tears its mortar, or is pulled back
  void renewConstants(BodyIndex body, const ShapeSet& shapes, const BodySet& bodies);
  void beginStep() {}
  void hash(Mix& h, MortarIndex mortar) const;
  void archive(WriteArchive& a) const;
  void archive(ReadArchive& a);
  void checkStructure(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;
  void checkRanges(Findings& f) const;
  void check(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;

  std::vector<MortarIndex> watched;  // broken a moment ago: who bears their load is being seen, ascending

 private:
  using Shared = std::array<std::uint32_t, sizeof(SharedStrength) / sizeof(float)>;  // bits of its numbers
  const SharedStrength* share(const SharedStrength& strength);
  void forget(BodyIndex gone);
  std::map<Shared, SharedStrength> shared_;  // its entries stay where they are
  std::vector<std::uint64_t> userData_;      // by mortar; as long as the last of them that is not 0
  std::vector<OpeningMemory> pasts_;         // of those that have cracked, by mortar ascending
};

}  // namespace brickfall
