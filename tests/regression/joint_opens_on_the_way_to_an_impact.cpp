// An impact within a step opened a joint of a linkage that falls. The part of the step was judged by how the joint was
// after that, and not taken again in halves: the joint ended open by 0.07 of its smaller body.
#include "law/random_linkage.h"

namespace brickfall {
namespace {

TEST(Regression, JointOpensOnTheWayToAnImpact) {
  law::RandomLinkage linkage = law::drawLinkage(law::LinkageKind::falls, 452);
  EXPECT_LT(law::runLinkage(linkage).gape, 0.05);
}

}  // namespace
}  // namespace brickfall
