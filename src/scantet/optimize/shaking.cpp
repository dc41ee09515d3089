// Hashes of coordinates stand for chance: the same part is shaken in the same way whatever else is done. A part is the
// tets within three rings of a bad one; its outermost tets stay as they are, so that it fits back into its place.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "scantet/base/coordinate_hash.h"
#include "scantet/base/parallel.h"
#include "scantet/optimize/shaking_impl.h"
#include "scantet/optimize/surface_guard_impl.h"

namespace scantet::optimize {
namespace {

constexpr int kTries = 64;                 // of a part
constexpr std::size_t kTriesInVain = 480;  // in a row, shared by all bad tets; each gets
constexpr std::size_t kLeastInVain = 6;    // at least so many,
constexpr std::size_t kMostInVain = 48;    // and at most
constexpr std::size_t kMostTets = 1500;    // of a part: where there are more, thousands of tets meet in a vertex
constexpr int kRings = 3;                  // around a bad tet
constexpr int kShakenRings = 1;            // of these
constexpr double kFarthest = 0.3;          // of a vertex's shortest edge

/// How bad a part is.
struct Badness {
  std::size_t count = 0;  // of elements that break a bound
  double sharpest = -1;   // of these

  bool is_less_than(const Badness& other) const {
    return count <= other.count && sharpest <= other.sharpest && (count < other.count || sharpest < other.sharpest);
  }
};

/// From 0 to 1, another one for each point, try and use.
double chance(const Point& p, int round, std::uint64_t use) {
  const std::uint64_t seed = static_cast<std::uint64_t>(round) * 16 + use;
  return static_cast<double>(hash_of_coordinates(p, kUsualMixing, seed) >> 11) * 0x1p-53;
}

/// A way in a direction, and of a length, by chance. Without a sine: those of other libraries differ in the last bit.
Vec way_at(const Point& p, int round, double longest_mm) {
  const Vec way{2 * chance(p, round, 1) - 1, 2 * chance(p, round, 2) - 1, 2 * chance(p, round, 3) - 1};
  const double long_as = length(way);
  return long_as > 0 ? (longest_mm * chance(p, round, 4) / long_as) * way : Vec{};
}

/// Moves the vertices of one part.
class Shaker {
 public:
  Shaker(TetComplex& complex, const Mending& mending)
      : complex_(complex), guard_(complex, mending.domain, mending.tolerance_mm, mending.facets) {}

  /// v stays where it is if it may not go there, or a tet would turn over.
  void shake(VertexId v, int round) {
    const Point before = complex_.point(v);
    const Vec way = way_at(before, round, kFarthest * shortest_edge(v));
    const std::optional<Point> place = place_after(v, way);
    if (!place) return;
    const bool on_boundary = complex_.on_boundary(v);
    complex_.move(v, *place, on_boundary);
    const auto turns = [&](TetId t) { return complex_.sharpness(complex_.tet(t)) == kInverted; };
    const auto star = complex_.star(v);
    if (std::any_of(star.begin(), star.end(), turns)) complex_.move(v, before, on_boundary);
  }

 private:
  double shortest_edge(VertexId v) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const TetId t : complex_.star(v)) {
      for (const VertexId w : complex_.tet(t)) {
        if (w != v) shortest = std::min(shortest, distance(complex_.point(v), complex_.point(w)));
      }
    }
    return shortest;
  }

  std::optional<Point> place_after(VertexId v, const Vec& way) {
    const Point& from = complex_.point(v);
    const Freedom freedom = guard_.freedom(v, fan_);
    if (freedom == Freedom::inside) return from + way;
    const double step_mm = length(way);
    if (freedom == Freedom::none || step_mm == 0) return std::nullopt;
    const Facets facets = guard_.facets(v, fan_);
    const Vec normal = SurfaceGuard::mean_normal(facets.all());
    const std::optional<Point> place = guard_.step_along(from, (1 / step_mm) * way, step_mm, normal, fan_);
    if (!place || !guard_.same_component(from, *place)) return std::nullopt;
    Facets moved = facets;
    for (Corners& facet : moved.all()) facet[0] = *place;
    if (guard_.rate_replacement(facets, moved, fan_) == kInverted) return std::nullopt;
    return place;
  }

  TetComplex& complex_;
  SurfaceGuard guard_;
  Fan fan_;
};

/// One part and what becomes of it.
class Trial {
 public:
  /// most_in_vain: tries in a row.
  Trial(const TetComplex& whole, TetId bad, const Mending& mending, std::size_t most_in_vain)
      : mending_(mending),
        most_in_vain_(most_in_vain),
        bad_(whole.tet(bad)),
        patch_(whole, tets_around(whole, std::array{bad}, kRings)) {}

  const Patch& patch() const { return patch_; }
  const Tet& bad() const { return bad_; }

  /// Returns the part when it is better; nothing if it never was.
  std::optional<TetComplex> run(const Progress& progress) {
    std::vector<TetId> bad;
    Badness least = look_at(patch_.complex(), bad);
    std::optional<TetComplex> best;
    if (patch_.complex().tet_slots() > kMostTets) return best;
    std::size_t in_vain = 0;
    for (int round = 0; round < kTries && in_vain < most_in_vain_ && least.count > 0; ++round) {
      if (progress.cancelled()) break;
      TetComplex tried = best ? *best : patch_.complex();
      look_at(tried, bad);
      shake(tried, bad, round);
      look_at(tried, bad);
      mending_.mend(tried, bad, [&](const Change& change) { return patch_.keeps_off_rim(change); });
      const Badness left = look_at(tried, bad);
      ++in_vain;
      if (!left.is_less_than(least)) continue;
      in_vain = 0;
      least = left;
      best = std::move(tried);
    }
    return best;
  }

 private:
  Badness look_at(const TetComplex& complex, std::vector<TetId>& bad) const {
    const ElementCheck check(complex, mending_.facets);
    Badness badness;
    bad.clear();
    for (TetId t = 0; t < complex.tet_slots(); ++t) {
      if (!complex.is_tet(t)) continue;
      const double sharpness = check.of(t);
      if (sharpness <= check.bound()) continue;
      bad.push_back(t);
      badness.sharpest = std::max(badness.sharpest, sharpness);
    }
    badness.count = bad.size();
    return badness;
  }

  void shake(TetComplex& complex, const std::vector<TetId>& bad, int round) const {
    Shaker shaker(complex, mending_);
    for (const VertexId v : vertices_of(complex, tets_around(complex, bad, kShakenRings))) {
      if (!patch_.is_on_rim(v)) shaker.shake(v, round);
    }
  }

  const Mending& mending_;
  std::size_t most_in_vain_;
  Tet bad_;
  Patch patch_;
};

}  // namespace

std::uint64_t shake(TetComplex& complex, const Mending& mending, const std::vector<TetId>& bad, Progress& progress) {
  constexpr std::uint32_t kNever = 0xffffffff;
  if (bad.empty()) return 0;
  std::uint64_t better = 0;
  const std::size_t most_in_vain = std::clamp(kTriesInVain / bad.size(), kLeastInVain, kMostInVain);
  const ElementCheck check(complex, mending.facets);
  std::vector<std::pair<TetId, Tet>> waiting;  // slots are reused: with their vertices
  for (const TetId t : bad) waiting.emplace_back(t, complex.tet(t));
  std::sort(waiting.begin(), waiting.end());
  waiting.erase(std::unique(waiting.begin(), waiting.end()), waiting.end());
  std::vector<std::uint32_t> taken(complex.vertex_slots(), kNever);  // by vertex: the last batch with a part around it
  std::vector<bool> in_vain(complex.vertex_slots(), false);  // by vertex: of a tet whose part never became better
  for (std::uint32_t batch = 0; !waiting.empty() && !progress.cancelled(); ++batch) {
    taken.resize(complex.vertex_slots(), kNever);
    in_vain.resize(complex.vertex_slots(), false);
    std::vector<Trial> trials;
    std::vector<std::pair<TetId, Tet>> later;
    for (const auto& [t, tet] : waiting) {
      if (!complex.is_tet(t) || complex.tet(t) != tet || check.of(t) <= check.bound()) continue;
      // Its part is nearly that of its neighbor.
      if (std::any_of(tet.begin(), tet.end(), [&](VertexId v) { return in_vain[v]; })) continue;
      Trial trial(complex, t, mending, most_in_vain);
      const std::vector<VertexId>& vertices = trial.patch().vertices();
      const auto is_taken = [&](VertexId v) { return taken[v] == batch; };
      if (std::any_of(vertices.begin(), vertices.end(), is_taken)) {
        later.emplace_back(t, tet);
        continue;
      }
      for (const VertexId v : vertices) taken[v] = batch;
      trials.push_back(std::move(trial));
    }
    std::vector<std::optional<TetComplex>> results(trials.size());
    parallel_for(trials.size(), 1, [&](std::size_t i, std::size_t) { results[i] = trials[i].run(progress); });
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (results[i]) {
        trials[i].patch().put_into(complex, *results[i]);
        ++better;
      } else {
        for (const VertexId v : trials[i].bad()) in_vain[v] = true;
      }
    }
    progress.report({"optimize", "shake", better, std::nullopt, later.size()});
    waiting = std::move(later);
  }
  return better;
}

}  // namespace scantet::optimize
