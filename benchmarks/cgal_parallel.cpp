#include <oneapi/tbb/global_control.h>

#include "cgal_mesh3_impl.h"

namespace scantet::bench {

Figures run_cgal_parallel(const Case& c, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  return run_cgal<CGAL::Parallel_tag>(c);
}

}  // namespace scantet::bench
