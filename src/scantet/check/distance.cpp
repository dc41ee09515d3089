// The two ways have a file each; what they have in common is here.
#include "scantet/check/distance.h"

#include <algorithm>

#include "scantet/check/distance_memory_impl.h"

namespace scantet {
namespace measuring {
namespace {

constexpr std::size_t kMostKept = 4096;
constexpr std::size_t kMostListed = 10;
constexpr double kWorthKeeping = 0.3;  // of the greatest distance
constexpr double kApart = 4;           // times the greatest distance, or a far place's own
constexpr std::size_t kMostFar = 1000;

bool farther(const FarPlace& a, const FarPlace& b) {
  if (a.distance_mm != b.distance_mm) return a.distance_mm > b.distance_mm;
  return lexicographically_less(a.point, b.point);
}

/// The farthest first. apart_mm: how near no place may be to a listed one.
template <class Apart>
std::vector<FarPlace> apart_from_each_other(std::vector<FarPlace> places, std::size_t most, const Apart& apart_mm) {
  std::sort(places.begin(), places.end(), farther);
  std::vector<FarPlace> kept;
  for (const FarPlace& place : places) {
    const auto is_near = [&](const FarPlace& listed) { return distance(listed.point, place.point) < apart_mm(listed); };
    if (std::any_of(kept.begin(), kept.end(), is_near)) continue;
    kept.push_back(place);
    if (kept.size() == most) break;
  }
  return kept;
}

}  // namespace

void Gathering::keep(const FarPlace& place) {
  sum_.lower_mm = std::max(sum_.lower_mm, place.distance_mm);
  if (place.distance_mm < kWorthKeeping * sum_.lower_mm) return;
  sum_.worst.push_back(place);
  if (sum_.worst.size() < 2 * kMostKept) return;
  std::sort(sum_.worst.begin(), sum_.worst.end(), farther);
  sum_.worst.resize(kMostKept);
}

void Gathering::add_if_far(const FarPlace& place) {
  if (may_be_far(place.distance_mm) && place.distance_mm > kFarInSizes * size_->size_at(place.point)) {
    sum_.far.push_back(place);
  }
}

void Gathering::add(const PartBounds& part, const Point& somewhere) {
  sum_.points += part.points;
  ++sum_.parts;
  upper_mm_ = std::max(upper_mm_, part.upper_mm);
  if (part.measured) keep(part.farthest);
  if (!limit_mm_ || part.upper_mm <= *limit_mm_) return;
  sum_.beyond.push_back(part.measured ? part.farthest : FarPlace{somewhere, somewhere, 0});
  sum_.undecided += sum_.beyond.back().distance_mm <= *limit_mm_ ? 1 : 0;
}

void Gathering::add(const Gathering& later) {
  sum_.points += later.sum_.points;
  sum_.parts += later.sum_.parts;
  sum_.undecided += later.sum_.undecided;
  sum_.beyond.insert(sum_.beyond.end(), later.sum_.beyond.begin(), later.sum_.beyond.end());
  sum_.far.insert(sum_.far.end(), later.sum_.far.begin(), later.sum_.far.end());
  upper_mm_ = std::max(upper_mm_, later.upper_mm_);
  for (const FarPlace& place : later.sum_.worst) keep(place);
}

OneWayDistance Gathering::result(bool bounded) const {
  OneWayDistance result = sum_;
  if (bounded) result.upper_mm = std::max(upper_mm_, sum_.lower_mm);
  result.worst = apart_from_each_other(std::move(result.worst), kMostListed,
                                       [&](const FarPlace&) { return kApart * result.lower_mm; });
  result.far = apart_from_each_other(std::move(result.far), kMostFar,
                                     [](const FarPlace& listed) { return kApart * listed.distance_mm; });
  return result;
}

std::vector<std::uint32_t> facets_of(const TetMesh& mesh, std::size_t surface) {
  std::vector<std::uint32_t> facets;
  for (std::uint32_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const auto [a, b] = mesh.facet_regions[i];
    if (std::min(a, b) <= static_cast<Region>(surface) && std::max(a, b) > static_cast<Region>(surface))
      facets.push_back(i);
  }
  return facets.empty() ? all_facets(mesh) : facets;
}

}  // namespace measuring

class DistanceMeter::Impl {
 public:
  explicit Impl(const Domain& domain) : domain_(domain) {}

  /// options: with the same limit each time.
  BoundaryDistance measure(const TetMesh& mesh, const DistanceOptions& options) {
    BoundaryDistance found;
    if (mesh.boundary_facets.empty()) return found;
    if (const BoundaryCells* cells = domain_.boundary_cells()) {
      memory_.resize(cells->surfaces());
      for (std::size_t surface = 0; surface < memory_.size(); ++surface) {
        memory_[surface].begin(mesh, measuring::facets_of(mesh, surface), options.limit_mm);
      }
      found.to_mesh = measuring::distance_to_mesh(mesh, *cells, options, memory_);
      found.to_domain = measuring::distance_to_domain(mesh, domain_, *cells, options, memory_);
    } else {
      found = measuring::sampled_distance(mesh, domain_, options);
    }
    found.limit_mm = options.limit_mm;
    return found;
  }

 private:
  const Domain& domain_;
  std::vector<measuring::SurfaceMemory> memory_;  // of each surface
};

DistanceMeter::DistanceMeter(const Domain& domain, double limit_mm)
    : impl_(std::make_unique<Impl>(domain)), limit_mm_(limit_mm) {}

DistanceMeter::~DistanceMeter() = default;

BoundaryDistance DistanceMeter::measure(const TetMesh& mesh, const SizingField* size) {
  return impl_->measure(mesh, {.limit_mm = limit_mm_, .size = size});
}

BoundaryDistance measure_distance(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options) {
  return DistanceMeter::Impl(domain).measure(mesh, options);
}

}  // namespace scantet
