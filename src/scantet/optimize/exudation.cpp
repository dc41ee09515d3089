// Slivers are taken worst first, a round of them at a time: their pumps are found side by side on the complex as it is,
// then made in order, each unless one made before it in the round has changed a tet that it was found from. A sweep
// goes once through all slivers; what it leaves and makes is for the next one.
#include <algorithm>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/optimize/exudation_impl.h"
#include "scantet/optimize/star_pump_impl.h"

namespace scantet::optimize {
namespace {

struct Sliver {
  double sharpness;
  TetId tet;
  Tet vertices;         // to know it again: slots are reused
  std::uint32_t tried;  // pumps made before it was last tried in vain
};

class Exudation {
 public:
  explicit Exudation(TetComplex& complex)
      : complex_(complex), bound_(complex.judge().bound()), weights_(complex.vertex_slots(), 0) {}

  std::uint64_t run(Progress& progress) {
    changed_.assign(complex_.tet_slots(), 0);
    for (find_all(); !slivers_.empty(); next_sweep()) {
      const std::size_t round = std::max(kLeastRound, complex_.tet_slots() / kTetsPerPump);
      for (std::size_t begin = 0; begin < slivers_.size(); begin += round) {
        if (progress.cancelled()) return pumps_;
        const std::size_t end = std::min(begin + round, slivers_.size());
        propose(begin, end);
        settle(begin, end);
        progress.report({"optimize", "exude", pumps_, std::nullopt, slivers_.size() - end + next_.size()});
      }
    }
    return pumps_;
  }

 private:
  static constexpr std::size_t kLeastRound = 32;
  static constexpr std::size_t kTetsPerPump = 512;  // in the mesh, for each pump of a round: most will be made

  bool exists(const Sliver& s) const { return complex_.is_tet(s.tet) && complex_.tet(s.tet) == s.vertices; }

  void find_all();
  void next_sweep();
  void sort_slivers();
  void propose(std::size_t begin, std::size_t end);
  void settle(std::size_t begin, std::size_t end);
  void apply(const Pump& pump);
  bool has_changed(const Sliver& s) const;

  TetComplex& complex_;
  double bound_;  // sharpness
  std::vector<double> weights_;
  std::vector<std::uint32_t> changed_;  // by tet: the last pump, from 1, that made it or weighted a vertex of it
  std::vector<Sliver> slivers_;         // of this sweep, worst first
  std::vector<Sliver> next_;            // of the next one
  std::vector<Sliver> in_vain_;
  std::vector<Pump> proposals_;  // of this round
  std::uint32_t pumps_ = 0;
};

void Exudation::find_all() {
  constexpr std::size_t kGrain = 8192;
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<Sliver>& found) {
    for (auto t = static_cast<TetId>(begin); t < end; ++t) {
      if (!complex_.is_tet(t)) continue;
      const double sharpness = complex_.sharpness(complex_.tet(t));
      if (sharpness > bound_) found.push_back({sharpness, t, complex_.tet(t), 0});
    }
  };
  slivers_ = parallel_collect<Sliver>(complex_.tet_slots(), kGrain, find);
  sort_slivers();
}

void Exudation::sort_slivers() {
  std::sort(slivers_.begin(), slivers_.end(), [](const Sliver& a, const Sliver& b) {
    return a.sharpness != b.sharpness ? a.sharpness > b.sharpness : a.tet < b.tet;
  });
}

/// What is left; when nothing is, what was tried in vain but has other tets around it now.
void Exudation::next_sweep() {
  slivers_.clear();
  std::swap(slivers_, next_);
  if (slivers_.empty()) {
    for (const Sliver& s : in_vain_) {
      if (exists(s)) (has_changed(s) ? slivers_ : next_).push_back(s);
    }
    in_vain_.clear();
    std::swap(in_vain_, next_);
  }
  sort_slivers();
}

bool Exudation::has_changed(const Sliver& s) const {
  for (const VertexId v : s.vertices) {
    for (const TetId t : complex_.star(v)) {
      if (changed_[t] > s.tried) return true;
    }
  }
  return false;
}

void Exudation::propose(std::size_t begin, std::size_t end) {
  constexpr std::size_t kGrain = 16;
  proposals_.resize(std::max(proposals_.size(), end - begin));
  parallel_for(end - begin, kGrain, [&](std::size_t first, std::size_t last) {
    StarPump star(complex_, weights_);
    for (std::size_t i = first; i < last; ++i) {
      const Sliver& sliver = slivers_[begin + i];
      proposals_[i].added.clear();
      proposals_[i].sharpest = sliver.sharpness;
      if (exists(sliver)) star.try_tet(sliver.tet, proposals_[i]);
    }
  });
}

void Exudation::settle(std::size_t begin, std::size_t end) {
  const std::uint32_t before = pumps_;
  const auto fresh = [&](TetId t) { return changed_[t] > before; };
  for (std::size_t i = begin; i < end; ++i) {
    Sliver& sliver = slivers_[i];
    const Pump& pump = proposals_[i - begin];
    if (!exists(sliver)) continue;
    if (!pump.found()) {
      sliver.tried = before;
      in_vain_.push_back(sliver);
    } else if (std::any_of(pump.read.begin(), pump.read.end(), fresh)) {
      next_.push_back(sliver);
    } else {
      apply(pump);
    }
  }
}

void Exudation::apply(const Pump& pump) {
  ++pumps_;
  weights_[pump.vertex] = pump.weight_mm2;
  for (const TetId t : pump.removed) changed_[t] = pumps_;
  complex_.replace(pump.removed, pump.added);
  changed_.resize(complex_.tet_slots(), 0);
  for (const TetId t : complex_.star(pump.vertex)) {
    changed_[t] = pumps_;
    if (pump.sharpest <= bound_) continue;
    const double sharpness = complex_.sharpness(complex_.tet(t));
    const auto is_new = [&](const NewTet& added) { return added.vertex == complex_.tet(t); };
    if (sharpness > bound_ && std::any_of(pump.added.begin(), pump.added.end(), is_new)) {
      next_.push_back({sharpness, t, complex_.tet(t), 0});
    }
  }
}

}  // namespace

std::uint64_t exude(TetComplex& complex, Progress& progress) {
  return Exudation(complex).run(progress);
}

}  // namespace scantet::optimize
