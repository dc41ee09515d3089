// The two ways have a file each; what they have in common is here.
#include "scantet/check/distance.h"

#include <algorithm>

#include "scantet/check/distance_impl.h"

namespace scantet {
namespace measuring {
namespace {

constexpr std::size_t kMostKept = 4096;
constexpr std::size_t kMostListed = 10;
constexpr double kWorthKeeping = 0.3;  // of the greatest distance
constexpr double kApart = 4;           // times the greatest distance

bool farther(const FarPlace& a, const FarPlace& b) {
  if (a.distance_mm != b.distance_mm) return a.distance_mm > b.distance_mm;
  return lexicographically_less(a.point, b.point);
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
  upper_mm_ = std::max(upper_mm_, later.upper_mm_);
  for (const FarPlace& place : later.sum_.worst) keep(place);
}

OneWayDistance Gathering::result(bool bounded) const {
  OneWayDistance result = sum_;
  if (bounded) result.upper_mm = std::max(upper_mm_, sum_.lower_mm);
  std::vector<FarPlace> all = std::move(result.worst);
  result.worst.clear();
  std::sort(all.begin(), all.end(), farther);
  for (const FarPlace& place : all) {
    const auto is_near = [&](const FarPlace& listed) {
      return distance(listed.point, place.point) < kApart * result.lower_mm;
    };
    if (std::any_of(result.worst.begin(), result.worst.end(), is_near)) continue;
    result.worst.push_back(place);
    if (result.worst.size() == kMostListed) break;
  }
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

BoundaryDistance measure_distance(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options) {
  BoundaryDistance found;
  if (mesh.boundary_facets.empty()) return found;
  if (const BoundaryCells* cells = domain.boundary_cells()) {
    found.to_mesh = measuring::distance_to_mesh(mesh, *cells, options);
    found.to_domain = measuring::distance_to_domain(mesh, domain, *cells, options);
  } else {
    found = measuring::sampled_distance(mesh, domain, options);
  }
  found.limit_mm = options.limit_mm;
  return found;
}

}  // namespace scantet
