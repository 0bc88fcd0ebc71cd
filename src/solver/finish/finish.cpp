#include "solver/finish/finish.h"

#include "solver/finish/motion.h"
#include "solver/joint/swings.h"

namespace brickfall {

void finishMotion(Island& island, Ties& ties, StepContext& context) {
  island.groups.find(island, context);
  storeMotion(island, context);
  if (island.resting()) return;
  finishFlights(island, context);
  finishLoneBody(island, ties, context);
  finishSlides(island, context);
  turnFarFreely(island, context);
  if (island.plan.endVelocities) finishSwings(island, ties, context);
}

}  // namespace brickfall
