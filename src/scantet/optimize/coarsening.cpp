// Rounds, as in worst_first.cpp: contractions are found side by side, then made in order, each unless one made before
// it has touched what it was found from. A vertex that is tried in vain is tried again when tets around it have
// changed. Each change takes a vertex away, so this ends.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/optimize/coarsening_impl.h"
#include "scantet/optimize/contraction_impl.h"
#include "scantet/optimize/worst_first_impl.h"

namespace scantet::optimize {
namespace {

/// A vertex with an edge that is too short.
struct Crowded {
  double share;  // of the edge that is shortest beside what is asked for
  VertexId vertex;
};

/// A neighbour, and what the edge to it has of what is asked for.
struct Neighbour {
  double share;
  VertexId vertex;

  friend bool operator<(const Neighbour& a, const Neighbour& b) {
    return a.share != b.share ? a.share < b.share : a.vertex < b.vertex;
  }
};

class Coarsening {
 public:
  Coarsening(TetComplex& complex, const Domain& domain, const FacetJudge* facets, const EdgeTarget& target,
             std::span<const Box> held)
      : complex_(complex),
        domain_(domain),
        facets_(facets),
        target_(target),
        held_(held),
        tolerance_mm_(typical_distance_mm(complex, domain)),
        changed_(complex.tet_slots(), 0) {}

  std::uint64_t run(Effort effort, Progress& progress) {
    std::vector<VertexId> all(complex_.vertex_slots());
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<VertexId>(v);
    for (list(all); !crowded_.empty(); take_up_again()) {
      const std::size_t round = std::max(kLeastRound, complex_.tet_slots() / kTetsPerChange);
      for (std::size_t begin = 0; begin < crowded_.size(); begin += round) {
        if (progress.cancelled()) return changes_;
        const std::size_t end = std::min(begin + round, crowded_.size());
        propose(begin, end, effort);
        settle(begin, end);
        progress.report({"optimize", "contract", changes_, std::nullopt, crowded_.size() - end});
      }
    }
    return changes_;
  }

 private:
  static constexpr std::size_t kLeastRound = 32;
  static constexpr std::size_t kTetsPerChange = 512;  // in the mesh, for each change of a round: most will be made

  void list(const std::vector<VertexId>& among);
  void take_up_again();
  void find_neighbours(VertexId v, std::vector<Neighbour>& neighbours) const;
  void find(VertexId v, Effort effort, Contraction& contraction, std::vector<Neighbour>& room, Change& best) const;
  void propose(std::size_t begin, std::size_t end, Effort effort);
  void settle(std::size_t begin, std::size_t end);
  void make(Change& change);

  TetComplex& complex_;
  const Domain& domain_;
  const FacetJudge* facets_;
  EdgeTarget target_;
  std::span<const Box> held_;
  double tolerance_mm_;
  std::vector<std::uint32_t> changed_;  // by tet: the last change, from 1, that made it or moved a vertex of it
  std::vector<Crowded> crowded_;        // what this sweep goes through, the worst first
  std::vector<VertexId> again_;         // what the next one looks at
  std::vector<Change> proposals_;       // one for each vertex of this round
  std::uint32_t changes_ = 0;
};

/// The neighbours of v, those nearest beside what is asked for first.
void Coarsening::find_neighbours(VertexId v, std::vector<Neighbour>& neighbours) const {
  neighbours.clear();
  for (const TetId t : complex_.star(v)) {
    for (const VertexId u : complex_.tet(t)) {
      if (u != v) neighbours.push_back({0, u});
    }
  }
  const auto by_id = [](const Neighbour& a, const Neighbour& b) { return a.vertex < b.vertex; };
  std::sort(neighbours.begin(), neighbours.end(), by_id);
  const auto same = [](const Neighbour& a, const Neighbour& b) { return a.vertex == b.vertex; };
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end(), same), neighbours.end());
  const Point& p = complex_.point(v);
  for (Neighbour& n : neighbours) {
    const Point& q = complex_.point(n.vertex);
    n.share = distance(p, q) / target_.least_mm(lerp(p, q, 0.5));
  }
  std::sort(neighbours.begin(), neighbours.end());
}

/// Lists those of the vertices that have an edge that is too short.
void Coarsening::list(const std::vector<VertexId>& among) {
  constexpr std::size_t kGrain = 1024;
  crowded_ = parallel_collect<Crowded>(among.size(), kGrain,
                                       [&](std::size_t begin, std::size_t end, std::vector<Crowded>& found) {
                                         std::vector<Neighbour> neighbours;
                                         for (std::size_t i = begin; i < end; ++i) {
                                           find_neighbours(among[i], neighbours);
                                           if (!neighbours.empty() && neighbours[0].share < 1)
                                             found.push_back({neighbours[0].share, among[i]});
                                         }
                                       });
  std::sort(crowded_.begin(), crowded_.end(), [](const Crowded& a, const Crowded& b) {
    return a.share != b.share ? a.share < b.share : a.vertex < b.vertex;
  });
}

void Coarsening::take_up_again() {
  std::sort(again_.begin(), again_.end());
  again_.erase(std::unique(again_.begin(), again_.end()), again_.end());
  list(again_);
  again_.clear();
}

/// Looks for a way to do without v, the first that keeps all bounds.
void Coarsening::find(VertexId v, Effort effort, Contraction& contraction, std::vector<Neighbour>& room,
                      Change& best) const {
  constexpr std::size_t kMostMoves = 3;
  const auto holds_v = [&](const Box& box) { return box.contains(complex_.point(v)); };
  if (std::any_of(held_.begin(), held_.end(), holds_v)) return;
  find_neighbours(v, room);
  if (room.empty() || room[0].share >= 1) return;
  const auto is_far = [&](const Neighbour& n) {
    return n.share >= 1 && distance(complex_.point(v), complex_.point(n.vertex)) > tolerance_mm_;
  };
  for (const Neighbour& n : room) {
    if (complex_.on_boundary(v) && (!complex_.on_boundary(n.vertex) || is_far(n))) continue;
    contraction.try_edge(v, n.vertex, best);
    if (best.found()) return;
  }
  if (effort == Effort::contract) return;
  for (std::size_t i = 0; i < std::min(room.size(), kMostMoves) && room[i].share < 1; ++i) {
    contraction.try_edge_moving(v, room[i].vertex, best);
    if (best.found()) return;
  }
}

void Coarsening::propose(std::size_t begin, std::size_t end, Effort effort) {
  constexpr std::size_t kGrain = 16;
  proposals_.resize(std::max(proposals_.size(), end - begin));
  parallel_for(end - begin, kGrain, [&](std::size_t first, std::size_t last) {
    SurfaceGuard guard(complex_, domain_, tolerance_mm_, facets_);
    Contraction contraction(complex_, guard);
    std::vector<Neighbour> room;
    for (std::size_t i = first; i < last; ++i) {
      proposals_[i].reset(std::nextafter(complex_.judge().bound(), kInverted));
      find(crowded_[begin + i].vertex, effort, contraction, room, proposals_[i]);
    }
  });
}

void Coarsening::settle(std::size_t begin, std::size_t end) {
  const std::uint32_t before = changes_;
  const auto fresh = [&](TetId t) { return changed_[t] > before; };
  for (std::size_t i = begin; i < end; ++i) {
    Change& change = proposals_[i - begin];
    if (!change.found()) continue;
    if (std::any_of(change.read.begin(), change.read.end(), fresh)) {
      again_.push_back(crowded_[i].vertex);
    } else {
      make(change);
    }
  }
}

void Coarsening::make(Change& change) {
  ++changes_;
  for (const TetId t : change.removed) {
    changed_[t] = changes_;
    again_.insert(again_.end(), complex_.tet(t).begin(), complex_.tet(t).end());
  }
  const std::span<const TetId> added = make_change(complex_, change);
  changed_.resize(complex_.tet_slots(), 0);
  for (const TetId t : added) changed_[t] = changes_;
  if (change.vertex == kNoVertex) return;
  for (const TetId t : complex_.star(change.vertex)) {
    changed_[t] = changes_;
    again_.insert(again_.end(), complex_.tet(t).begin(), complex_.tet(t).end());
  }
}

}  // namespace

std::uint64_t coarsen(TetComplex& complex, const Domain& domain, const FacetJudge* facets, const EdgeTarget& target,
                      std::span<const Box> held, Effort effort, Progress& progress) {
  return Coarsening(complex, domain, facets, target, held).run(effort, progress);
}

}  // namespace scantet::optimize
