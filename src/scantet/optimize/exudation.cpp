// A sliver's remedy is a pump: a weight for a vertex that makes the sliver leave the weighted Delaunay triangulation.
// Weights only grow, and each is tried as far as no vertex can be hidden.
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/optimize/exudation_impl.h"
#include "scantet/optimize/star_pump_impl.h"
#include "scantet/optimize/worst_first_impl.h"

namespace scantet::optimize {
namespace {

class Pumping final : public Remedy {
 public:
  Pumping(const TetComplex& complex, std::span<const double> weights_mm2) : star_(complex, weights_mm2) {}
  void find(TetId t, Change& best) override { star_.try_tet(t, best); }

 private:
  StarPump star_;
};

std::vector<TetId> find_slivers(const TetComplex& complex, double bound) {
  constexpr std::size_t kGrain = 8192;
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<TetId>& found) {
    for (auto t = static_cast<TetId>(begin); t < end; ++t) {
      if (complex.is_tet(t) && complex.sharpness(complex.tet(t)) > bound) found.push_back(t);
    }
  };
  return parallel_collect<TetId>(complex.tet_slots(), kGrain, find);
}

}  // namespace

std::uint64_t exude(TetComplex& complex, Progress& progress) {
  std::vector<double> weights_mm2(complex.vertex_slots(), 0);
  const ElementCheck check(complex, nullptr);
  Treatment pumping{"exude", [&] { return std::make_unique<Pumping>(complex, weights_mm2); }};
  pumping.made = [&](const Change& change) { weights_mm2[change.weighted] = change.weight_mm2; };
  pumping.moves_vertices = false;
  return change_worst_first(complex, check, find_slivers(complex, check.bound()), pumping, progress).changes;
}

}  // namespace scantet::optimize
