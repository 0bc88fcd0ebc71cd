// Row 30t: nothing comes from nothing, and joints stay closed, in linkages of any bodies (law/random_linkage.h).
#include "law/law.h"
#include "law/random_linkage.h"
#include "law/sweeps.h"

namespace brickfall::law {

namespace {

constexpr double kMostGain = 0.01;  // of what moved most
constexpr double kGape = 0.05;      // of the size of a joint's smaller body
constexpr double kMostOff = 1e-9;   // of the sum over all bodies

}  // namespace

void sweepRandomLinkages(int cases) {
  for (int k = 0; k < kLinkageKinds; k++) {
    const LinkageKind kind = LinkageKind(k);
    int gained = 0, open = 0, lost = 0;
    double push = 0, spin = 0;
    for (int i = 0; i < cases; i++) {
      RandomLinkage linkage = drawLinkage(kind, i);
      const LinkageOutcome found = runLinkage(linkage);
      EXPECT_TRUE(found.finite) << linkage.text;
      gained += found.gain > kMostGain;
      open += found.gape > kGape;
      lost += !found.finite;
      push = std::max(push, found.linear), spin = std::max(spin, found.angular);
    }
    const bool floats = kind == LinkageKind::floats;
    const std::string where = std::string(nameOf(kind)) + label(", %g linkages: ", cases);
    atMost(where + "gain more than a hundredth", 0, gained, 0, "");
    // Known: one in a thousand.
    const double few = std::max(1.0, cases / 400.0);
    atMost(where + "left open by more than 5 % of a body", 0, open, 0, "", few);
    atMost(where + "with a body that is lost", 0, lost, 0, "");
    if (!floats) continue;
    atMost(where + "linear momentum", 0, push, kMostOff, "");
    atMost(where + "angular momentum", 0, spin, kMostOff, "");
  }
}

}  // namespace brickfall::law
