// Darts are thrown at the candidates: those of the finest spacing first, and then in an order shuffled by a hash of the
// coordinates. Then the sample is evened out (sample_relaxation.cpp), and points that came too near another point by
// that are dropped.
#include "scantet/sampling/initial_sample.h"

#include "scantet/base/coordinate_hash.h"
#include "scantet/base/error.h"
#include "scantet/base/large_pages.h"
#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/sampling/closer_candidates_impl.h"
#include "scantet/sampling/hinted_spacing_impl.h"
#include "scantet/sampling/sample_relaxation_impl.h"

namespace scantet {
namespace {

using engine::Dart;

constexpr double kPoissonShare = 0.92;    // of alpha·σ: a little under what R2 allows
constexpr double kFeatureShare = 0.5;     // of the local feature size near a feature
constexpr double kCandidateShare = 0.5;   // candidate spacing over Poisson radius: dense enough to be maximal
constexpr double kRelaxedShare = 0.75;    // of the Poisson radius: what is left of it when the sample is evened out
constexpr double kFirstLook = 1.0 / 128;  // of the longest side of the bounds: components larger than that are found
constexpr double kTwoLooks = 4;           // the first look over the finest spacing: from that on a second look pays
constexpr std::size_t kGrain = 1024;

/// The turn of a candidate: finer octaves of the radius first, at random within an octave.
std::uint64_t turn_of(const Point& p, double radius_mm, std::uint64_t seed) {
  const std::uint64_t h = hash_of_coordinates(p, kUsualMixing, seed * 0x9e3779b97f4a7c15ULL + 0x853c49e6748fea9bULL);
  constexpr int kBits = 12;  // of the exponent of a double
  const int octave = std::ilogb(radius_mm) + (1 << (kBits - 1));
  return static_cast<std::uint64_t>(octave) << (64 - kBits) | h >> kBits;
}

/// Spacing of the sample at a point: by σ, and by the hints around.
class Spacing {
 public:
  Spacing(const Domain& domain, const SizingField& size, double alpha, bool near_hints) : size_(size), alpha_(alpha) {
    std::vector<SizeHint> hints;
    if (!near_hints) return;
    domain.size_hints([&](const SizeHint& hint) {
      if (kFeatureShare * hint.radius_mm < by_size(hint.point)) hints.push_back(hint);
    });
    hinted_ = HintedSpacing(std::move(hints), kFeatureShare, kPoissonShare * alpha * size.min_size());
  }
  Dart dart_at(const Point& p, std::uint64_t seed) const {
    const double nominal = by_size(p);
    const double spacing = hinted_.at(p, nominal);
    return {p, spacing, turn_of(p, spacing, seed), spacing < nominal};
  }
  const std::vector<SizeHint>& hints() const { return hinted_.hints(); }
  /// The spacing of candidates that a sample around p needs, features apart.
  double candidates_at(const Point& p) const { return kCandidateShare * by_size(p); }
  double candidate_share() const { return kCandidateShare * kPoissonShare * alpha_; }  // of σ

 private:
  double by_size(const Point& p) const { return kPoissonShare * alpha_ * size_.size_at(p); }

  const SizingField& size_;
  double alpha_;
  HintedSpacing hinted_;
};

/// Boundary points around a hint: the crossings nearest to it in the directions of a cube's corners, edges and
/// faces.
void cast_around(const Domain& domain, const SizeHint& hint, Crossings& crossings, const PointSink& sink) {
  for (const Vec& direction : kNeighborDirections) {
    const double norm = length(direction);
    for (double reach : {1.5, 4.0}) {
      domain.crossings({hint.point, hint.point + (reach * hint.radius_mm / norm) * direction}, crossings);
      if (crossings.empty()) continue;
      sink(crossings.front().point);
      break;
    }
  }
}

/// Boundary points around all hints.
std::vector<Point> cast_around_all(const Domain& domain, const std::vector<SizeHint>& hints) {
  constexpr std::size_t kHints = 64;
  return parallel_collect<Point>(
      hints.size(), kHints, [&](std::size_t begin, std::size_t end, std::vector<Point>& points) {
        Crossings crossings;
        for (std::size_t i = begin; i < end; ++i) {
          cast_around(domain, hints[i], crossings, [&](const Point& p) { points.push_back(p); });
        }
      });
}

/// Refuses a search that would take far more effort than the points allowed can need.
class Effort {
 public:
  Effort(std::uint64_t max_points, double size_mm)
      : most_candidates_(kCandidates * (max_points + kFew)),
        most_lines_(kLines * (static_cast<double>(max_points) + kFew)),
        size_mm_(size_mm) {}

  /// Lines along each axis through the box.
  void check_lines(const Box& box, double spacing_mm) const {
    const Vec n = (1 / spacing_mm) * box.extent();
    if (n.x * n.y + n.y * n.z + n.z * n.x > most_lines_) refuse();
  }
  void check_candidates(std::size_t count) const {
    if (count > most_candidates_) refuse();
  }
  /// Looks at the boundary a second time.
  std::vector<Point> closer_candidates(const Domain& domain, std::span<const Point> points,
                                       const engine::CandidateScale& scale) const {
    std::optional<std::vector<Point>> closer = engine::closer_candidates(domain, points, scale, most_lines_);
    if (!closer) refuse();
    check_candidates(closer->size());
    return std::move(*closer);
  }

 private:
  static constexpr std::uint64_t kCandidates = 64;  // for each point; there are about ten
  static constexpr double kLines = 100;             // for each point; through a cube there are about three
  static constexpr std::uint64_t kFew = 5000;

  [[noreturn]] void refuse() const {
    throw Error(Fault::usage, "usage.size",
                "size: " + std::to_string(size_mm_) +
                    " mm is so small beside the object that to sample its boundary alone takes far more points than "
                    "allowed",
                "choose a larger --size, or allow more with --max-vertices");
  }
  std::size_t most_candidates_;
  double most_lines_;
  double size_mm_;
};

/// The candidates as darts. finest_mm: the spacing that the smallest size asks for. Where it is less than candidate_mm,
/// the boundary is looked at a second time, closer where the size is less.
LargeVector<Dart> collect_darts(const Domain& domain, const Spacing& spacing, double candidate_mm, double finest_mm,
                                std::uint64_t seed, const Effort& effort) {
  constexpr std::size_t kRoom = std::size_t{1} << 21;  // memory that is not written costs nothing; growing does
  LargeVector<Point> points;
  points.reserve(kRoom);
  effort.check_lines(domain.bounds(), candidate_mm);
  domain.surface_candidates(candidate_mm, [&](const Point& p) {
    points.push_back(p);
    effort.check_candidates(points.size());
  });
  if (candidate_mm > finest_mm) {
    const engine::CandidateScale scale{candidate_mm, finest_mm, spacing.candidate_share(),
                                       [&](const Point& p) { return spacing.candidates_at(p); }};
    const std::vector<Point> closer = effort.closer_candidates(domain, points, scale);
    points.insert(points.end(), closer.begin(), closer.end());
  }
  const std::vector<Point> around = cast_around_all(domain, spacing.hints());
  points.insert(points.end(), around.begin(), around.end());
  LargeVector<Dart> darts;
  darts.resize(points.size());
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) darts[i] = spacing.dart_at(points[i], seed);
  });
  return darts;
}

std::vector<Point> sample_on_this_thread(const Domain& domain, const SizingField& size, const SampleOptions& options,
                                         Progress& progress) {
  const Spacing spacing(domain, size, options.alpha, options.near_hints);
  LargeVector<Dart> darts;
  // A domain smaller than σ still gets points: look closer until there are enough to span space.
  constexpr std::size_t kEnough = 8;
  const Vec extent = domain.bounds().extent();
  const double finest_mm = spacing.candidate_share() * size.min_size();
  double candidate_mm = std::min(finest_mm, 0.25 * domain.bounds().diagonal());
  const double first_mm =
      std::min(spacing.candidate_share() * size.usual_size(), kFirstLook * std::max({extent.x, extent.y, extent.z}));
  if (first_mm > kTwoLooks * finest_mm) candidate_mm = first_mm;
  const Effort effort(options.max_points, size.min_size());
  for (int attempt = 0; attempt < 8 && darts.size() < kEnough; ++attempt, candidate_mm /= 2) {
    darts = collect_darts(domain, spacing, candidate_mm, finest_mm, options.seed, effort);
  }
  if (darts.empty()) {
    throw Error(Fault::input, "input.empty", "the domain has no boundary: no line through its bounds crosses it",
                "check the level and the bounds");
  }
  progress.report({"sample", "P_i", 0, std::nullopt, darts.size()});
  LargeVector<Dart> sample = engine::throw_darts(darts, 1);
  progress.report({"sample", "P_i", sample.size(), std::nullopt, 0});
  engine::relax_sample(domain, sample);
  sample = engine::throw_darts(sample, kRelaxedShare);
  std::vector<Point> points;
  points.reserve(sample.size());
  for (const Dart& dart : sample) points.push_back(dart.point);
  return points;
}

}  // namespace

std::vector<Point> initial_sample(const Domain& domain, const SizingField& size, const SampleOptions& options,
                                  Progress& progress) {
  progress.report({"sample", "boundary", 0, std::nullopt, 0});
  std::vector<Point> points;
  const bool done =
      run_interruptible(progress, [&] { points = sample_on_this_thread(domain, size, options, progress); });
  return done ? points : std::vector<Point>();
}

}  // namespace scantet
