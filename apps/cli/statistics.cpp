#include "cli/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace brickfall::cli {

Distribution distributionOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double share) {
    const std::size_t place = std::size_t(std::ceil(share * double(values.size())));
    return values[std::clamp<std::size_t>(place, 1, values.size()) - 1];
  };
  double sum = 0;
  for (double value : values) sum += value;
  return {sum / double(values.size()), rank(0.5), rank(0.95), values.back()};
}

}  // namespace brickfall::cli
