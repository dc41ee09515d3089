#include "cgal_mesh3_impl.h"

namespace scantet::bench {

Figures run_cgal_sequential(const Case& c) {
  return run_cgal<CGAL::Sequential_tag>(c);
}

}  // namespace scantet::bench
