// Hashes of what each stage wrote, to find the first place where two runs part. What depends on the history of the tree
// (candidate pairs without points, kept bounds) is left out: a restored world gives the same hashes.
#include <bit>
#include <type_traits>

#include "world/world_impl.h"

namespace brickfall {

std::string_view nameOf(const StageHash& hash) {
  return hash.stage && *hash.stage < Stage::count ? kStageNames[std::size_t(*hash.stage)] : "given";
}

namespace {

// 64 bits at a time; base/hash.h goes byte by byte, too slow for all that a step writes. -0 counts as 0.
class Mix {
 public:
  template <class... Values> Mix& operator()(const Values&... values) {
    (add(values), ...);
    return *this;
  }
  template <class T> Mix& list(const T* values, int count) {
    for (int i = 0; i < count; i++) add(values[i]);
    return *this;
  }
  std::uint64_t value() const { return value_; }

 private:
  void word(std::uint64_t bits) {
    value_ = (value_ ^ bits) * 0x9e3779b97f4a7c15ull;
    value_ ^= value_ >> 29;
  }
  template <class T> void add(const T& v) {
    if constexpr (std::is_floating_point_v<T>)
      word(v == 0 ? 0 : std::bit_cast<std::uint64_t>(double(v)));
    else
      word(std::uint64_t(v));
  }
  template <class T> void add(const Vec3T<T>& v) { (*this)(v.x, v.y, v.z); }
  void add(const Quat& q) { (*this)(q.x, q.y, q.z, q.w); }
  void add(const Aabb& box) { (*this)(box.lower, box.upper); }
  std::uint64_t value_ = 0x243f6a8885a308d3ull;
};

void mix(Mix& h, const BodyMotion& m) { h(m.position, m.rotation, m.linearVelocity, m.angularVelocity); }
void mix(Mix& h, const SolvedMotion& s) { h(s.d, s.th, s.velocity, s.angularMomentum, s.freeTurn, s.rest, s.flying); }
void mix(Mix& h, const FreeMotion& f) { h(f.d, f.th, f.rotation, f.angularMomentum, f.startVelocity, f.startSpin); }
struct MixPoints {
  Mix& h;
  int count;
  template <class T> void operator()(const T (&lanes)[4], PointQuantity = {}) const { h.list(lanes, count); }
  void operator()(std::uint32_t mask) const { h(mask); }
};
void mix(Mix& h, const Contact& c) {
  h(c.shapeA, c.shapeB, c.count, c.rolls, c.weak, c.touching, c.weakSteps, c.friction, c.restitution, c.effectiveMass);
  eachField(c.points, MixPoints{h, c.count});
}
void mix(Mix& h, const ContactGeometry& g, int count) {
  h(g.relativePosition, g.relativeRotation, g.normal, g.tangent1, g.centre);
  h.list(g.anchorA, count).list(g.anchorB, count);
}
void mix(Mix& h, const ContactRecord& r, int count) {
  h(r.n, r.t1, r.armA, r.armB, r.newPoints);
  for (const float* field : {r.s1, r.s2, r.trialN, r.trial1, r.trial2, r.k, r.limit, r.bond}) h.list(field, count);
}

// The items of one stage, in the order in which they are added.
class Items {
 public:
  explicit Items(bool keep) : keep_(keep) {}
  void add(BodyId a, BodyId b, const Mix& item) {
    sum_(a.index, a.generation, b.index, b.generation, item.value());
    if (keep_) items_.push_back({a, b, item.value()});
  }
  StageHash take(int substep, std::optional<Stage> stage) { return {substep, stage, sum_.value(), std::move(items_)}; }

 private:
  bool keep_;
  Mix sum_;
  std::vector<ItemHash> items_;
};

}  // namespace

void World::Impl::hashStage(std::optional<Stage> stage) {
  Items items(traceOptions.items);
  auto eachBody = [&](const auto& list, auto write) {
    for (BodyIndex body : list) {
      Mix h;
      write(h, body);
      items.add(idOf(body), {}, h);
    }
  };
  auto eachPair = [&](const auto& list, auto write) {
    for (const CandidatePair& pair : list) {
      if (pair.contact == kNoIndex) continue;
      Mix h;
      write(h, contacts.contacts[pair.contact], contacts.geometry[pair.contact]);
      items.add(idOf(pair.bodyA), idOf(pair.bodyB), h);
    }
  };
  // What is said of an island as a whole is said of its first body.
  auto eachIsland = [&](const auto& list, auto write) {
    for (const auto& island : list) {
      Mix h;
      write(h, *island);
      items.add(idOf(island->key()), {}, h);
    }
  };
  auto wholeContact = [](Mix& h, const Contact& c, const ContactGeometry& g) {
    mix(h, c);
    mix(h, g, c.count);
  };
  auto eachRecord = [&](auto write) {
    for (const auto& island : islands.awake)
      for (std::size_t k = 0; k < island->rows.contacts.records.size(); k++) {
        const Contact& c = contacts.contacts[island->rows.contacts.contactOf[k]];
        Mix h;
        write(h, *island, k, c);
        items.add(idOf(c.bodyA), idOf(c.bodyB), h);
      }
  };
  // Of an island that is passed over, what was solved once is not read any more.
  auto eachSolved = [&] {
    auto write = [&](Mix& h, BodyIndex body) { mix(h, context.solved[body]); };
    eachBody(islands.single, write);
    for (const auto& island : islands.awake)
      if (!island->settled()) eachBody(island->bodies, write);
  };

  switch (stage.value_or(Stage::count)) {
    case Stage::count:
      eachBody(bodies.inOrder(), [&](Mix& h, BodyIndex body) {
        const BodyData& d = bodies.data[body];
        mix(h, bodies.motion[body]);
        h(int(d.type), int(d.activity), d.quarantined, d.gravityScale, d.linearDamping, d.angularDamping, d.dragArea,
          d.force, d.torque, d.lastKineticEnergy, bodies.still[body]);
      });
      eachPair(contacts.pairs, wholeContact);
      eachPair(contacts.asleep, wholeContact);
      for (const auto* list : {&islands.awake, &islands.asleep})
        eachIsland(*list, [](Mix& h, const Island& i) { h(int(i.ending), i.restTime, i.heldTime); });
      break;
    case Stage::pairs:
      for (const auto* list : {&awake, &moving})
        eachBody(*list, [&](Mix& h, BodyIndex body) {
          for (ShapeIndex shape : bodies.shapes[body]) h(shapes.data[shape].swept);
        });
      break;
    case Stage::contacts:
      eachPair(contacts.pairs, wholeContact);
      break;
    case Stage::islands:
      eachBody(islands.single, [](Mix&, BodyIndex) {});
      eachIsland(islands.awake, [&](Mix& h, const Island& i) {
        h.list(i.bodies.data(), int(i.bodies.size())).list(i.partners.data(), int(i.partners.size()));
        for (ContactIndex contact : i.rows.contacts.contactOf)
          h(contacts.contacts[contact].shapeA, contacts.contacts[contact].shapeB);
      });
      break;
    case Stage::prepare:
      eachBody(islands.single, [&](Mix& h, BodyIndex body) { mix(h, context.free[body]); });
      for (const auto& island : islands.awake) {
        if (island->settled()) continue;
        eachBody(island->bodies, [&](Mix& h, BodyIndex body) {
          mix(h, context.free[body]);
          mix(h, bodies.motion[body]);
        });
      }
      eachRecord([](Mix& h, const Island& island, std::size_t k, const Contact& c) {
        mix(h, c);
        mix(h, island.rows.contacts.records[k], c.count);
      });
      break;
    case Stage::rest:
      eachIsland(islands.awake, [](Mix& h, const Island& i) { h(!i.settled() && i.plan.slow, int(i.ending)); });
      break;
    case Stage::solve:
      for (const auto& island : islands.awake) {
        if (island->resting()) continue;
        for (std::size_t k = 0; k < island->bodies.size(); k++) {
          Mix h;
          h(island->motion[k].d, island->motion[k].th);
          items.add(idOf(island->bodies[k]), {}, h);
        }
      }
      break;
    case Stage::store:
      eachSolved();
      eachRecord([](Mix& h, const Island& island, std::size_t, const Contact& c) {
        mix(h, c);
        h(int(island.ending), island.heldTime);
      });
      break;
    case Stage::restitution:
      eachSolved();
      eachRecord([](Mix& h, const Island&, std::size_t, const Contact& c) { mix(h, c); });
      break;
    case Stage::integrate:
      for (const auto* list : {&awake, &moving})
        eachBody(*list, [&](Mix& h, BodyIndex body) {
          mix(h, bodies.motion[body]);
          h(bodies.still[body], bodies.data[body].quarantined, bodies.data[body].linearAcceleration,
            bodies.data[body].angularAcceleration);
        });
      eachRecord([](Mix& h, const Island&, std::size_t, const Contact& c) { mix(h, c); });
      break;
    case Stage::sleep:
      for (const auto* list : {&islands.awake, &islands.asleep})
        eachIsland(*list, [&](Mix& h, const Island& i) { h(int(bodies.data[i.key()].activity), i.restTime); });
      break;
    case Stage::events:
      for (const auto* list : {&events.begin, &events.end})
        for (const ContactEvent& e : *list) items.add(e.bodyA, e.bodyB, Mix()(list == &events.begin));
      for (const HitEvent& e : events.hits)
        items.add(e.bodyA, e.bodyB, Mix()(e.pointWorld, e.normalWorld, e.approachSpeed, e.impulse));
      for (const auto* list : {&events.moved, &events.fellAsleep, &events.woke})
        for (BodyId body : *list) items.add(body, {}, Mix()(list == &events.moved, list == &events.woke));
      break;
  }
  report.stageHashes.push_back(items.take(substep, stage));
}

}  // namespace brickfall
