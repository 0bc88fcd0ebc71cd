// Pairs of hulls whose contact was wrong, one test per symptom. Most were found by the sweep of tests/oracle/collision.
#include <gtest/gtest.h>

#include <algorithm>

#include "contact_checks.h"

namespace brickfall {
namespace {

using namespace test;

Hull hullOf(const std::vector<Vec3>& corners) { return buildHull(corners).value(); }

struct Sides {
  Manifold m, back;  // the second seen from a, too
};
Sides bothWays(const Shape& a, const Shape& b, const Transform& pose, double margin) {
  Sides out;
  collide(a, b, pose, margin, out.m);
  out.back = swapped(a, b, pose, margin);
  return out;
}

// Nothing lies over the face that is the best axis, but for one corner high above it; another axis was better, not by its
// bias. The contact was that corner, 3 mm apart, of solids that overlap.
TEST(HullContact, OverlapIsHiddenByAPointThatIsApart) {
  Hull shard = hullOf({{-0.05579636, -0.04579358, -0.02471346},
                       {-0.02980411, -0.07919421, -0.04687871},
                       {-0.02660173, -0.1285978, -0.007958865},
                       {0.01654317, -0.04533585, -0.06212981},
                       {0.05681849, 0.01098682, 0.0304957},
                       {0.0626699, 0.02519503, -0.003879445}});
  Shape a = boxShape({0.0809139, 0.1570715, 0.3401739}), b = hullShape(shard);
  Transform pose{{0.0119434369, 0.1900186603, 0.3794144596},
                 normalized(Quat{-0.0556850872144, 0.2795821264, -0.444925728903, 0.848984158521})};
  Separation slow = slowSeparation(a, b, pose);
  ASSERT_NEAR(slow.value, -0.000214, 1e-6);
  ASSERT_TRUE(slow.edge);
  Sides found = bothWays(a, b, pose, 0.005);
  for (const Manifold* m : {&found.m, &found.back}) {
    ASSERT_GT(m->count, 0);
    EXPECT_NEAR(deepest(*m), slow.value, 1e-5);
  }
}

// The same where the better axis is the next face's.
TEST(HullContact, OverlapIsHiddenByAFaceThatIsAsGood) {
  Hull first = hullOf({{-0.09250485, 0.1110582, 0.04802453},
                       {-0.05543586, -0.1447821, -0.06973313},
                       {-0.04940969, -0.2226815, -0.004106769},
                       {-0.0423151, 0.2284294, -0.005319729},
                       {0.03690554, -0.2210425, 0.03116362},
                       {0.05292671, -0.04937941, -0.09227706},
                       {0.05426638, -0.192827, 0.04407382},
                       {0.0590658, 0.2087741, 0.01839329},
                       {0.0746169, -0.1549174, -0.04903747},
                       {0.07890453, -0.06578245, 0.07459806},
                       {0.09948072, -0.1304138, -0.02050804}});
  Hull second = hullOf({{-0.1454468, -0.05726296, -0.04415379},
                        {-0.1352861, -0.0369575, 0.1789169},
                        {-0.09798489, -0.1390297, 0.0490871},
                        {-0.07184571, 0.1487371, -0.1406418},
                        {-0.06736728, -0.1467159, 0.1651152},
                        {-0.03930815, 0.1244094, -0.2817818},
                        {-0.03655915, -0.1769097, -0.01601776},
                        {-0.007992618, 0.1075547, 0.3314741},
                        {0.006141942, 0.06534688, 0.3837413},
                        {0.03708806, -0.1382118, 0.2492657},
                        {0.07822253, -0.08060159, -0.3043203}});
  Transform pose{{0.07344056055, -0.1758751929, 0.3384136559},
                 normalized(Quat{-0.22738525229, 0.12669090986, -0.836756561203, 0.481750783791})};
  Shape a = hullShape(first), b = hullShape(second);
  Separation slow = slowSeparation(a, b, pose);
  ASSERT_NEAR(slow.value, -0.004731, 1e-6);
  Sides found = bothWays(a, b, pose, 0.01);
  for (const Manifold* m : {&found.m, &found.back}) {
    ASSERT_GT(m->count, 0);
    EXPECT_LE(deepest(*m), slow.value + 1e-5);
    EXPECT_GE(deepest(*m), slow.value - 0.034 * std::min(innerRadius(a), innerRadius(b))) << "by the bias for faces";
  }
}

// A blade with a tip of two degrees: a corner 3 micrometres beyond each of its sides, which is let through, was up to 0.17 mm
// beyond its tip.
TEST(HullContact, PointsAreBeyondTheTipOfASliver) {
  Hull blade =
      hullOf({{0, 0, 0}, {0.6, 0, 0.0105}, {0.6, 0, -0.0105}, {0, -0.1, 0}, {0.6, -0.1, 0.0105}, {0.6, -0.1, -0.0105}});
  Hull top = hullOf({{0, 0, 0}, {0.1, 0.1, 0.1}, {-0.1, 0.1, 0.1}, {0.1, 0.1, -0.1}, {-0.1, 0.1, -0.1}});
  Shape a = hullShape(blade), b = hullShape(top);
  Random random(3);
  int contacts = 0, atTip = 0;
  for (int i = 0; i < 4000; i++) {
    Transform pose{{random.between(-5e-4, 5e-4), random.between(-1e-4, 2e-3), random.between(-4e-6, 4e-6)},
                   quatFromRotationVector(randomDirection(random) * 0.3)};
    Sides found = bothWays(a, b, pose, 0.003);
    contacts += found.m.count > 0;
    for (const Manifold* m : {&found.m, &found.back})
      for (int k = 0; k < m->count; k++) {
        ASSERT_LT(distanceByGjk(a, m->points[k].onA), 3e-5) << i;
        atTip += length(m->points[k].onA) < 2e-4;
      }
  }
  EXPECT_GT(contacts, 2000);
  EXPECT_GT(atTip, 200);
}

// Corner beside edge, with a gap of nothing. What is below a face and over it need not be inside where the hull is narrower
// below: a corner there was taken for an overlap of 12 mm, along an axis across the gap.
TEST(HullContact, OverlapIsShownWhereThereIsAGap) {
  Hull rock = hullOf({{-0.4121277, -0.152599, -0.05012463},
                      {-0.3883922, 0.1375195, -0.07337923},
                      {-0.3837662, -0.09843981, 0.08584836},
                      {-0.357055, -0.1441135, -0.08757956},
                      {-0.3356905, 0.06443022, -0.1103667},
                      {-0.2054156, -0.3224008, -0.05355059},
                      {-0.09918659, 0.1175705, 0.1482794},
                      {-0.0877733, -0.3619079, 0.04540262},
                      {-0.03428841, -0.1797562, 0.1406081},
                      {-0.02914412, -0.1752104, 0.1417207}});
  Shape a = boxShape({0.02230912, 0.05614201, 0.09146802}), b = hullShape(rock);
  Transform touching{{0.07614369128, -0.002782863514, -0.2928522441},
                     normalized(Quat{0.413490524934, -0.298220111728, -0.750335343207, 0.420817327929})};
  ASSERT_NEAR(slowSeparation(a, b, touching).value, 0, 1e-6);
  int seen = 0;
  for (double gap : {1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
    Transform pose = touching;
    pose.position += Vec3{0.276, 0, -0.9612} * gap;  // from the nearest point to the nearest
    Sides found = bothWays(a, b, pose, 0.005);
    for (const Manifold* m : {&found.m, &found.back}) {
      EXPECT_EQ(faultOf(*m, a, b, pose, 0.005, 1e-4), "");
      if (m->count > 0) {
        EXPECT_GE(deepest(*m), 0) << gap;
        seen++;
      }
    }
  }
  EXPECT_GT(seen, 2);
}

// An edge lies flush on a face; both of its ends are the deepest corner, and the face most opposed around one of them is not
// over the other. Which end came first decided whether the contact showed the overlap.
TEST(HullContact, DepthDependsOnWhichEndOfAFlushEdgeIsFirst) {
  Hull first = hullOf({{-0.04187882, -0.003140024, -0.02822559},
                       {-0.03842401, 0.04204798, -0.03036235},
                       {-0.0218513, 0.09519427, 0.03035025},
                       {-0.01861814, 0.00218358, -0.07492287},
                       {-0.01242324, 0.05962094, 0.06787988},
                       {0.0266982, 0.0964073, 0.002673436},
                       {0.02924521, -0.09054169, -0.005793761},
                       {0.03282727, 0.02082425, 0.05395865},
                       {0.0358274, 0.05439847, 0.03198838},
                       {0.03846245, 0.05634686, -0.01588712}});
  Hull second = hullOf({{0.004928818, 0.0265889, -0.03345167},
                        {0.006746356, -0.1038359, 0.009163286},
                        {0.03587973, -0.08912386, -0.001609393},
                        {0.05935796, -0.02416461, 0.009250008}});
  Shape a = hullShape(first), b = hullShape(second);
  Transform flush{{0.09880665065, 0.05133149861, -0.01245838018},
                  normalized(Quat{0.378213099661, 0.844339968673, -0.32954561278, -0.188267250585})};
  ASSERT_NEAR(slowSeparation(a, b, flush).value, -1.685e-5, 1e-7);
  Random random(4);
  for (int i = 0; i < 200; i++) {
    Transform pose = flush;
    pose.rotation = normalized(quatFromRotationVector(randomDirection(random) * 1e-7) * pose.rotation);
    Sides found = bothWays(a, b, pose, 0.0013);
    for (const Manifold* m : {&found.m, &found.back}) {
      ASSERT_GT(m->count, 1) << i;
      ASSERT_NEAR(deepest(*m), slowSeparation(a, b, pose).value, 3e-6) << i;
    }
  }
}

}  // namespace
}  // namespace brickfall
