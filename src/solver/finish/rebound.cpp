// Restitution as a velocity pass. For each impact the time and speed within the step are found from the gap at its start;
// wanted are e times that speed at the end of the step and the gap that the rest of the step opens. All other points of
// the island may close no further than they did. Every manifold is solved exactly (a small linear complementarity problem
// with an even share among its points, so that a flat cube does not turn), sweeps run over the island until nothing
// changes; once for displacements, once for velocities. The result is scaled back if energy would rise (Newton's law of
// restitution; bodies that touch before the impact stay inelastic towards each other).
#include "solver/finish/rebound.h"

#include <algorithm>
#include <cmath>

namespace brickfall {

namespace {

struct Motion {
  Vec3 linear, angular;
};

// Inverse masses in world axes, zero for partners.
struct Response {
  double invMass = 0;
  Mat3 invInertia{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
};

struct Impact {
  bool happens = false;
  double speedAfter = 0;  // m/s, separation at the end of the step
  double gapAfter = 0;    // m
};

struct Block {
  std::uint32_t a = 0, b = 0;  // in Island::motion
  int count = 0;
  Vec3 normal;
  Vec3 armA[4], armB[4];
  bool impact[4] = {};
  double gap[4] = {};
  double wantedSpeed[4] = {}, wantedMove[4] = {};
  double response[4][4] = {};  // relative normal speed at i per unit impulse at j
  double impulse[4] = {};
};

struct Pass {
  explicit Pass(std::pmr::memory_resource* memory)
      : blocks(memory), response(memory), velocities(memory), moves(memory) {}
  std::pmr::vector<Block> blocks;
  std::pmr::vector<Response> response;
  std::pmr::vector<Motion> velocities, moves;
};

// m/s: slower impacts do not rebound. In a heap every body would chatter with its neighbours; a body alone on something
// fixed bounces on until a bounce takes no more than two steps.
double slowestRebound(const Island& island, const StepContext& context) {
  double wanted = context.settings.restitutionSpeed;
  return island.bodies.size() == 1 ? std::min(wanted, length(context.gravity) * context.dt) : wanted;
}

// When in the step the surfaces met, and what follows: rebound, then free motion for the rest of the step.
Impact findImpact(const Contact& c, const ContactStart& start, int i, Vec3 normal, double slowest,
                  const StepContext& context) {
  Impact impact;
  if (c.restitution == 0 || !(c.points.forceN[i] > 0)) return impact;
  const auto& data = context.bodies->data;
  double along = dot(normal, context.gravity);
  double pull = (data[c.bodyB].flying ? along : 0) - (data[c.bodyA].flying ? along : 0);
  double approach = start.approach[i], gap = std::max(0.0f, start.gap[i]);
  double closing2 = approach * approach - 2 * pull * gap;  // impact speed squared, by energy
  if (approach >= 0 || closing2 <= 0) return impact;
  double closing = std::sqrt(closing2);
  double time = std::min(context.dt, 2 * gap / (closing - approach));
  closing = -approach - pull * time;
  if (closing <= slowest) return impact;
  double left = context.dt - time;
  impact.happens = true;
  impact.speedAfter = double(c.restitution) * closing + pull * left;
  impact.gapAfter = std::max(0.0, double(c.restitution) * closing * left + 0.5 * pull * left * left);
  return impact;
}

double normalMotion(const Block& k, int i, const std::pmr::vector<Motion>& motions) {
  const Motion &a = motions[k.a], &b = motions[k.b];
  return dot(k.normal, b.linear + cross(b.angular, k.armB[i]) - a.linear - cross(a.angular, k.armA[i]));
}

void push(const Block& k, int i, double impulse, const std::pmr::vector<Response>& response,
          std::pmr::vector<Motion>& motions) {
  Vec3 p = k.normal * impulse;
  motions[k.a].linear -= p * response[k.a].invMass;
  motions[k.a].angular -= response[k.a].invInertia * cross(k.armA[i], p);
  motions[k.b].linear += p * response[k.b].invMass;
  motions[k.b].angular += response[k.b].invInertia * cross(k.armB[i], p);
}

// sum_j response_ij x_j = -speed_i over the active points, by Gaussian elimination. Four points of one face are one too
// many for a rigid body: the tiny extra diagonal picks the even share.
void solveActive(const Block& k, const double* speed, const bool* active, double* x) {
  double rows[4][5];
  int index[4], n = 0;
  for (int i = 0; i < k.count; i++) {
    x[i] = 0;
    if (active[i]) index[n++] = i;
  }
  for (int r = 0; r < n; r++) {
    for (int c = 0; c < n; c++) rows[r][c] = k.response[index[r]][index[c]];
    rows[r][r] *= 1 + 1e-7;
    rows[r][n] = -speed[index[r]];
  }
  for (int r = 0; r < n; r++)
    for (int below = r + 1; below < n; below++) {
      double factor = rows[below][r] / rows[r][r];
      for (int c = r; c <= n; c++) rows[below][c] -= factor * rows[r][c];
    }
  for (int r = n - 1; r >= 0; r--) {
    double sum = rows[r][n];
    for (int c = r + 1; c < n; c++) sum -= rows[r][c] * x[index[c]];
    x[index[r]] = sum / rows[r][r];
  }
}

// Impulses >= 0, speeds >= wanted, no impulse where the speed is higher. Active set: drop the most negative impulse, else
// take in the most violated speed.
void solveBlock(const Block& k, const double* speed, double* x) {
  bool active[4];
  double scale = 0;
  for (int i = 0; i < k.count; i++) {
    active[i] = true;
    scale = std::max(scale, std::fabs(speed[i]));
  }
  for (int iteration = 0; iteration < 16; iteration++) {
    solveActive(k, speed, active, x);
    int change = -1;
    double worst = 0;
    for (int i = 0; i < k.count; i++)
      if (x[i] < worst) {
        worst = x[i];
        change = i;
      }
    if (change < 0) {
      worst = -1e-6 * scale;
      for (int i = 0; i < k.count; i++) {
        if (active[i]) continue;
        double excess = speed[i];
        for (int j = 0; j < k.count; j++) excess += k.response[i][j] * x[j];
        if (excess < worst) {
          worst = excess;
          change = i;
        }
      }
    }
    if (change < 0) return;
    active[change] = !active[change];
  }
  for (int i = 0; i < k.count; i++) x[i] = std::max(0.0, x[i]);
}

// Sweeps forwards and backwards until nothing changes by more than a thousandth of the largest wanted motion.
void solveImpulses(Pass& pass, bool forSpeed) {
  std::pmr::vector<Motion>& motions = forSpeed ? pass.velocities : pass.moves;
  double largest = 0;
  for (Block& k : pass.blocks)
    for (int i = 0; i < k.count; i++) {
      k.impulse[i] = 0;
      largest = std::max(largest, forSpeed ? k.wantedSpeed[i] : k.wantedMove[i]);
    }
  std::size_t count = pass.blocks.size();
  for (int sweep = 0; sweep < kRestitutionSweeps; sweep++) {
    double change = 0;
    for (std::size_t n = 0; n < count; n++) {
      Block& k = pass.blocks[sweep % 2 == 0 ? n : count - 1 - n];
      double without[4], next[4];
      for (int i = 0; i < k.count; i++) {
        without[i] = normalMotion(k, i, motions) - (forSpeed ? k.wantedSpeed[i] : k.wantedMove[i]);
        for (int j = 0; j < k.count; j++) without[i] -= k.response[i][j] * k.impulse[j];
      }
      solveBlock(k, without, next);
      for (int i = 0; i < k.count; i++) {
        double extra = next[i] - k.impulse[i];
        change = std::max(change, std::fabs(extra) * k.response[i][i]);
        push(k, i, extra, pass.response, motions);
        k.impulse[i] = next[i];
      }
    }
    if (change < 1e-3 * largest) break;
  }
}

Vec3 endVelocity(const StepContext& context, BodyIndex body) { return context.solved[body].velocity; }
Vec3 endSpin(const StepContext& context, BodyIndex body) {
  return context.bodies->worldInvInertia(body) * context.solved[body].angularMomentum;
}

void makeBlocks(const Island& island, const StepContext& context, Pass& pass) {
  double slowest = slowestRebound(island, context);
  const ContactSet& set = *context.contacts;
  pass.blocks.reserve(island.rows.contacts.contactOf.size());
  for (std::size_t n = 0; n < island.rows.contacts.contactOf.size(); n++) {
    const Contact& c = set.contacts[island.rows.contacts.contactOf[n]];
    const ContactRecord& r = island.rows.contacts.records[n];
    Block k;
    k.a = r.bodyA;
    k.b = r.bodyB;
    k.count = c.count;
    k.normal = toDouble(r.n);
    Vec3 t1 = toDouble(r.t1), t2 = cross(k.normal, t1);
    for (int i = 0; i < c.count; i++) {
      Vec3 place = t1 * double(r.s1[i]) + t2 * double(r.s2[i]);
      k.armA[i] = toDouble(r.armA) + place;
      k.armB[i] = toDouble(r.armB) + place;
      k.gap[i] = island.rows.contacts.starts[n].gap[i];
    }
    for (int i = 0; i < c.count; i++)
      for (int j = 0; j < c.count; j++) {
        const Response &a = pass.response[k.a], &b = pass.response[k.b];
        k.response[i][j] = a.invMass + b.invMass +
                           dot(cross(k.armA[i], k.normal), a.invInertia * cross(k.armA[j], k.normal)) +
                           dot(cross(k.armB[i], k.normal), b.invInertia * cross(k.armB[j], k.normal));
      }
    for (int i = 0; i < c.count; i++) {
      Impact impact = findImpact(c, island.rows.contacts.starts[n], i, k.normal, slowest, context);
      k.impact[i] = impact.happens;
      k.wantedSpeed[i] = impact.speedAfter;
      k.wantedMove[i] = impact.gapAfter - k.gap[i];
      if (!impact.happens) k.wantedMove[i] = std::min(-k.gap[i], normalMotion(k, i, pass.moves));
    }
    pass.blocks.push_back(k);
  }
}

// The share of the change under which kinetic plus potential energy does not exceed that at the start of the step, or what
// the primal solve left if that is more.
double allowedShare(const Island& island, const StepContext& context, const Pass& pass) {
  double room = 0, linear = 0, square = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyIndex body = island.bodies[i];
    const FreeMotion& free = context.free[body];
    double m = context.bodies->mass[body].mass;
    Mat3 inertia = context.bodies->worldInertia(body);
    Vec3 v = endVelocity(context, body), w = endSpin(context, body);
    Vec3 dv = pass.velocities[i].linear - v, dw = pass.velocities[i].angular - w;
    Vec3 g = context.gravity * context.bodies->data[body].gravityScale;
    double start =
        0.5 * m * dot(free.startVelocity, free.startVelocity) + 0.5 * dot(free.startSpin, inertia * free.startSpin);
    double end = 0.5 * m * dot(v, v) + 0.5 * dot(w, inertia * w);
    room += start - end + m * dot(g, context.solved[body].d);
    linear += m * dot(v, dv) + dot(w, inertia * dw) - m * dot(g, pass.moves[i].linear - context.solved[body].d);
    square += 0.5 * m * dot(dv, dv) + 0.5 * dot(dw, inertia * dw);
  }
  double left = std::max(0.0, room);
  if (linear + square <= left) return 1;
  if (!(square > 0)) return 0;
  return std::clamp((std::sqrt(linear * linear + 4 * square * left) - linear) / (2 * square), 0.0, 1.0);
}

bool anyImpact(const Island& island, const StepContext& context) {
  double slowest = slowestRebound(island, context);
  for (std::size_t n = 0; n < island.rows.contacts.contactOf.size(); n++) {
    const Contact& c = context.contacts->contacts[island.rows.contacts.contactOf[n]];
    if (c.restitution == 0) continue;
    for (int i = 0; i < c.count; i++)
      if (findImpact(c, island.rows.contacts.starts[n], i, toDouble(island.rows.contacts.records[n].n), slowest,
                     context)
              .happens)
        return true;
  }
  return false;
}

}  // namespace

void rebound(Island& island, Ties ties, StepContext& context) {
  if (island.resting() || !anyImpact(island, context)) return;
  const BodySet& bodies = *context.bodies;
  std::size_t count = island.bodies.size();
  Pass pass(island.memory);
  pass.response.resize(island.motion.size());
  pass.velocities.resize(island.motion.size());
  pass.moves.resize(island.motion.size());
  for (std::size_t i = 0; i < count; i++) {
    BodyIndex body = island.bodies[i];
    pass.response[i] = {bodies.mass[body].invMass, bodies.worldInvInertia(body)};
    pass.velocities[i] = {endVelocity(context, body), endSpin(context, body)};
    pass.moves[i] = {context.solved[body].d, context.solved[body].th};
  }
  for (std::size_t i = 0; i < island.partners.size(); i++) {
    const BodyMotion& m = bodies.motion[island.partners[i]];
    pass.velocities[count + i] = {m.linearVelocity, m.angularVelocity};
    pass.moves[count + i] = {m.linearVelocity * context.dt, m.angularVelocity * context.dt};
  }
  makeBlocks(island, context, pass);
  solveImpulses(pass, false);
  for (Block& k : pass.blocks)
    for (int i = 0; i < k.count; i++) {
      if (k.impact[i]) continue;
      double gapAfter = k.gap[i] + normalMotion(k, i, pass.moves);
      k.wantedSpeed[i] = std::min(normalMotion(k, i, pass.velocities), -std::max(0.0, gapAfter) / context.dt);
    }
  solveImpulses(pass, true);

  double share = allowedShare(island, context, pass);
  for (std::size_t i = 0; i < count; i++) {
    BodyIndex body = island.bodies[i];
    SolvedMotion& s = context.solved[body];
    Vec3 dw = pass.velocities[i].angular - endSpin(context, body);
    Vec3 dth = pass.moves[i].angular - s.th;
    s.velocity += (pass.velocities[i].linear - s.velocity) * share;
    s.angularMomentum += bodies.worldInertia(body) * dw * share;
    s.d += (pass.moves[i].linear - s.d) * share;
    if (lengthSquared(dth) > 0) s.freeTurn = false;
    s.th += dth * share;
  }
  for (std::size_t n = 0; n < pass.blocks.size(); n++)
    for (int i = 0; i < pass.blocks[n].count; i++)
      // The surfaces part: the force of the impact must act in no later step.
      if (pass.blocks[n].impact[i]) clearPoint(ties.contacts.contacts[island.rows.contacts.contactOf[n]].points, i);
}

}  // namespace brickfall
