#include "qhull_oracle.h"

#include <cstdio>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace brickfall::test {

QhullAnswer qhull(const std::vector<Vec3>& points) {
  std::vector<coordT> coordinates;
  for (Vec3 p : points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  std::FILE* nowhere = std::fopen("/dev/null", "w");
  qhT state;
  qh_zero(&state, nowhere);
  char options[] = "qhull";
  QhullAnswer answer;
  if (qh_new_qhull(&state, 3, int(points.size()), coordinates.data(), False, options, nowhere, nowhere) == 0) {
    qh_getarea(&state, state.facet_list);
    answer.volume = state.totvol;
    answer.vertices = std::size_t(state.num_vertices);
    answer.facets = std::size_t(state.num_facets);
    bool first = true;
    for (facetT* facet = state.facet_list; facet && facet->next; facet = facet->next) {
      if (!first && -facet->offset >= answer.leastDepth) continue;
      first = false;
      answer.leastDepth = -facet->offset;
      answer.leastNormal = {facet->normal[0], facet->normal[1], facet->normal[2]};
    }
  }
  qh_freeqhull(&state, !qh_ALL);
  int buffers = 0, bytes = 0;
  qh_memfreeshort(&state, &buffers, &bytes);
  std::fclose(nowhere);
  return answer;
}

}  // namespace brickfall::test
