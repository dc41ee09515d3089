// Dart throwing over the candidates: finest spacing first, then in an order shuffled by a hash of the coordinates; a
// candidate is kept if no kept point is nearer than its spacing. A hashed grid answers the neighbour queries.
#include "scantet/refine/initial_sample.h"

#include <bit>
#include <unordered_map>

#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr double kPoissonShare = 0.95;   // of alpha·σ: a little under what R2 allows
constexpr double kFeatureShare = 0.5;    // of the local feature size near a feature
constexpr double kCandidateShare = 0.5;  // candidate spacing over Poisson radius: dense enough to be maximal
constexpr int kDirections = 26;          // cast from each feature

/// Points hashed by the cube they are in.
class PointGrid {
 public:
  explicit PointGrid(double cube_mm) : inverse_(1 / cube_mm) {}

  void add(const Point& p) {
    const auto [entry, fresh] = heads_.try_emplace(key(cube(p.x), cube(p.y), cube(p.z)), kEnd);
    points_.push_back({p, entry->second});
    entry->second = static_cast<std::uint32_t>(points_.size() - 1);
  }

  /// Calls visit(index, point) for the points in the cubes that the ball of this radius meets, until it returns true.
  template <class Visit>
  bool any_near(const Point& p, double radius_mm, Visit visit) const {
    for (std::int64_t x = cube(p.x - radius_mm); x <= cube(p.x + radius_mm); ++x) {
      for (std::int64_t y = cube(p.y - radius_mm); y <= cube(p.y + radius_mm); ++y) {
        for (std::int64_t z = cube(p.z - radius_mm); z <= cube(p.z + radius_mm); ++z) {
          const auto head = heads_.find(key(x, y, z));
          if (head == heads_.end()) continue;
          for (std::uint32_t i = head->second; i != kEnd; i = points_[i].next) {
            if (visit(i, points_[i].point)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kEnd = 0xffffffff;
  struct Entry {
    Point point;
    std::uint32_t next;
  };
  std::int64_t cube(double coordinate) const { return static_cast<std::int64_t>(std::floor(coordinate * inverse_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    constexpr std::uint64_t kMask = (1U << 21) - 1;  // far cubes may share a key: then a visit is wasted, no more
    return (static_cast<std::uint64_t>(x) & kMask) << 42 | (static_cast<std::uint64_t>(y) & kMask) << 21 |
           (static_cast<std::uint64_t>(z) & kMask);
  }
  double inverse_;
  std::unordered_map<std::uint64_t, std::uint32_t> heads_;
  std::vector<Entry> points_;
};

struct Candidate {
  Point point;
  double radius_mm;
  int octave;          // of the radius: finer ones are thrown first
  std::uint64_t dart;  // random order within an octave
};

std::uint64_t dart(const Point& p, std::uint64_t seed) {
  std::uint64_t h = seed * 0x9e3779b97f4a7c15ULL + 0x853c49e6748fea9bULL;
  for (double coordinate : {p.x, p.y, p.z}) {
    h = (h ^ std::bit_cast<std::uint64_t>(coordinate)) * 0xbf58476d1ce4e5b9ULL;
    h ^= h >> 29;
  }
  return h;
}

/// Spacing of the sample at a point: by σ, and by the features around.
class Spacing {
 public:
  Spacing(const Domain& domain, const SizingField& size, double alpha, double largest_mm)
      : size_(size), alpha_(alpha), reach_mm_(largest_mm / kFeatureShare), grid_(reach_mm_) {
    domain.features([&](const Feature& feature) {
      if (kFeatureShare * feature.radius_mm >= largest_mm) return;
      grid_.add(feature.point);
      features_.push_back(feature);
    });
  }
  double at(const Point& p) const {
    double spacing = kPoissonShare * alpha_ * size_.size_at(p);
    if (features_.empty()) return spacing;
    grid_.any_near(p, reach_mm_, [&](std::uint32_t i, const Point& center) {
      spacing = std::min(spacing, kFeatureShare * (features_[i].radius_mm + distance(p, center)));
      return false;
    });
    return spacing;
  }
  const std::vector<Feature>& features() const { return features_; }

 private:
  const SizingField& size_;
  double alpha_;
  double reach_mm_;
  PointGrid grid_;
  std::vector<Feature> features_;
};

/// Boundary points around a feature: the crossings nearest to it in the directions of a cube's corners, edges and
/// faces.
void cast_around(const Domain& domain, const Feature& feature, Crossings& crossings, const PointSink& sink) {
  for (int i = 0; i <= kDirections; ++i) {
    const Vec direction{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
    const double norm = length(direction);
    if (norm == 0) continue;
    for (double reach : {1.5, 4.0}) {
      domain.crossings({feature.point, feature.point + (reach * feature.radius_mm / norm) * direction}, crossings);
      if (crossings.empty()) continue;
      sink(crossings.front().point);
      break;
    }
  }
}

std::vector<Candidate> collect_candidates(const Domain& domain, const Spacing& spacing, double candidate_mm,
                                          std::uint64_t seed) {
  std::vector<Candidate> candidates;
  const PointSink add = [&](const Point& p) {
    const double radius = spacing.at(p);
    candidates.push_back({p, radius, std::ilogb(radius), dart(p, seed)});
  };
  domain.surface_candidates(candidate_mm, add);
  Crossings crossings;
  for (const Feature& feature : spacing.features()) cast_around(domain, feature, crossings, add);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if (a.octave != b.octave) return a.octave < b.octave;
    return a.dart != b.dart ? a.dart < b.dart : lexicographically_less(a.point, b.point);
  });
  return candidates;
}

}  // namespace

std::vector<Point> initial_sample(const Domain& domain, const SizingField& size, const SampleOptions& options,
                                  Progress& progress) {
  const double finest_mm = kPoissonShare * options.alpha * size.min_size();
  const double largest_mm = std::min(domain.bounds().diagonal(), 1e3 * finest_mm);
  const Spacing spacing(domain, size, options.alpha, largest_mm);
  std::vector<Candidate> candidates;
  // A domain smaller than σ still gets points: look closer until there are enough to span space.
  constexpr std::size_t kEnough = 8;
  double candidate_mm = std::min(kCandidateShare * finest_mm, 0.25 * domain.bounds().diagonal());
  for (int attempt = 0; attempt < 8 && candidates.size() < kEnough; ++attempt, candidate_mm /= 2) {
    candidates = collect_candidates(domain, spacing, candidate_mm, options.seed);
  }
  if (candidates.empty()) {
    throw Error(Fault::input, "input.empty", "the domain has no boundary: no line through its bounds crosses it",
                "check the level and the bounds");
  }
  std::vector<Point> sample;
  PointGrid kept(finest_mm);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    const double squared = c.radius_mm * c.radius_mm;
    const auto too_near = [&](std::uint32_t, const Point& q) { return squared_distance(c.point, q) < squared; };
    if (kept.any_near(c.point, c.radius_mm, too_near)) continue;
    kept.add(c.point);
    sample.push_back(c.point);
    if (i % 4096 == 0) progress.report({"sample", "P_i", sample.size(), std::nullopt, candidates.size() - i});
    if (i % 4096 == 0 && progress.cancelled()) break;
  }
  return sample;
}

}  // namespace scantet
