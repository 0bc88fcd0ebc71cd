// Mean, median and the like of many measured values.
#pragma once
#include <vector>

namespace brickfall::cli {

struct Distribution {
  double mean = 0, median = 0, p95 = 0, max = 0;
};
// All 0 for no values. Percentiles are the nearest rank: the smallest value that so many are not above.
Distribution distributionOf(std::vector<double> values);

}  // namespace brickfall::cli
