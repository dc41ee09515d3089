// The mesh against its domain, with the domain's queries alone.
//
// A component of the domain is known by a point in it. The first crossings of rays from there lie on its boundary, and
// the patches of these crossings name the pieces of boundary they hit: if a vertex of the mesh lies on one of them, the
// mesh has it.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "scantet/base/options.h"
#include "scantet/check/audit_impl.h"
#include "scantet/domain/known_components.h"

namespace scantet::auditing {
namespace {

/// A circumcentre and how far rounding may have moved it, here and where the mesh was made.
struct Circumcentre {
  Point place;
  double error_mm;
};

/// Doubles lose up to nine digits in flat tets.
template <class Long>
std::optional<Circumcentre> circumcentre(const TetMesh& mesh, const Tet& t) {
  using Row = std::array<Long, 3>;
  const Point& origin = mesh.vertices[t[0]];
  const auto row = [&](VertexId v) {
    const Point& p = mesh.vertices[v];
    return Row{Long{p.x} - origin.x, Long{p.y} - origin.y, Long{p.z} - origin.z};
  };
  const auto cross_of = [](const Row& u, const Row& v) {
    return Row{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const auto dot_of = [](const Row& u, const Row& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  const Row a = row(t[1]);
  const Row b = row(t[2]);
  const Row c = row(t[3]);
  const Row bc = cross_of(b, c);
  const Row ca = cross_of(c, a);
  const Row ab = cross_of(a, b);
  const Long det = dot_of(a, bc);
  if (det == 0) return std::nullopt;
  const Long aa = dot_of(a, a);
  const Long bb = dot_of(b, b);
  const Long cc = dot_of(c, c);
  Row center;
  for (std::size_t i = 0; i < 3; ++i) center[i] = (aa * bc[i] + bb * ca[i] + cc * ab[i]) / (2 * det);
  const auto radius = static_cast<double>(std::sqrt(dot_of(center, center)));
  const Point place{static_cast<double>(center[0] + origin.x), static_cast<double>(center[1] + origin.y),
                    static_cast<double>(center[2] + origin.z)};
  constexpr double kWorstFlatness = 1e9;  // who computes in doubles must go to exact numbers there at the latest
  constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
  const auto flatness = static_cast<double>(std::sqrt(aa) * std::sqrt(bb) * std::sqrt(cc) / std::abs(det));
  return Circumcentre{place, kRounding * (radius * std::min(flatness, kWorstFlatness) + length(place))};
}

bool region_near(const Domain& domain, const Circumcentre& center, Region region) {
  if (domain.region_at(center.place) == region) return true;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {-center.error_mm, center.error_mm}) {
      Point p = center.place;
      p[axis] += step;
      if (domain.region_at(p) == region) return true;
    }
  }
  return false;
}

/// What the six axis rays from the witness of a component hit first.
struct Walls {
  std::vector<Patch> patches;
  bool volume =
      true;  ///< false if the rays of an axis end where they begin: a point, line or sheet at the level itself
};

Walls walls_of(const Component& component, const Domain& domain) {
  constexpr double kRounding = 1e-12;
  Walls walls;
  const Box bounds = domain.bounds();
  Crossings crossings;
  for (int axis = 0; axis < 3; ++axis) {
    double extent_mm = 0;
    for (const double end : {bounds.min[axis] - bounds.diagonal(), bounds.max[axis] + bounds.diagonal()}) {
      Segment ray{component.witness, component.witness};
      ray.target[axis] = end;
      domain.crossings(ray, crossings);
      extent_mm += distance(component.witness, crossings.empty() ? ray.target : crossings.front().point);
      if (!crossings.empty()) walls.patches.push_back(crossings.front().patch());
    }
    walls.volume = walls.volume && extent_mm > kRounding * bounds.diagonal();
  }
  return walls;
}

class LedgerCheck {
 public:
  LedgerCheck(const TetMesh& mesh, const std::vector<VertexId>& vertices, const Domain& domain, AuditReport& report)
      : report_(report) {
    for (const VertexId v : vertices) in_mesh_.insert(patches_[v] = domain.patch_at(mesh.vertices[v]));
    std::set<Patch> distinct;
    const ComponentList known = known_components(domain);
    knows_all_ = known.are_all;
    for (const Component& component : known.components) {
      Walls walls = walls_of(component, domain);
      if (component.region == kOutside && !walls.volume) continue;
      distinct.insert(walls.patches.begin(), walls.patches.end());
      listed_.push_back({component, std::move(walls.patches)});
    }
    tells_apart_ = !knows_all_ || listed_.size() == 1 || distinct.size() > 1;
  }

  /// Of a domain that knows only some of its components the others cannot be counted.
  void run() {
    ComponentLedger ledger;
    for (const ListedComponent& listed : listed_) {
      const Component& component = listed.component;
      const bool cavity = component.region == kOutside;
      ++(cavity ? ledger.expected_cavities : ledger.expected_components);
      if (found(listed)) continue;
      ledger.missing.push_back(component);
      (cavity ? missing_cavities_ : missing_components_).hit(component.witness, [&] { return describe(component); });
    }
    record(missing_components_, report_);
    record(missing_cavities_, report_);
    if (!knows_all_) return;
    compare_components(ledger);
    Tally cavities{"audit.cavity_count"};
    compare(report_.cavities, ledger.expected_cavities - missing_cavities_.count, ledger.expected_cavities, "",
            cavities);
    if (!report_.cavity_walls.empty()) cavities.places = {report_.cavity_walls.back().box_mm.center()};
    record(cavities, report_);
    report_.ledger = std::move(ledger);
  }

  void compare_handles(const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                       const OutsideSurfaces& outside) {
    check_handles(match, component_of, outside, listed_, knows_all_, tells_apart_ ? &patches_ : nullptr, report_);
  }

 private:
  bool found(const ListedComponent& listed) const {
    const Component& component = listed.component;
    if (tells_apart_) {
      return std::any_of(listed.walls.begin(), listed.walls.end(),
                         [&](const Patch& patch) { return in_mesh_.count(patch) > 0; });
    }
    return std::any_of(report_.components.begin(), report_.components.end(), [&](const MeshComponent& m) {
      return (component.region == kOutside || m.region == component.region) && m.box_mm.meets(component.box_mm);
    });
  }

  static std::string describe(const Component& component) {
    std::string text = "the one";
    if (component.volume_mm3 > 0) text += " of about " + number_text(component.volume_mm3, 4) + " mm3";
    return text + " in a box of " + number_text(component.box_mm.extent().x, 4) + " x " +
           number_text(component.box_mm.extent().y, 4) + " x " + number_text(component.box_mm.extent().z, 4) + " mm";
  }

  // Region by region: one too many of one would make up for one too few of another.
  void compare_components(const ComponentLedger& ledger) {
    struct Counts {
      std::uint64_t have = 0;
      std::uint64_t missing = 0;
      std::uint64_t in_domain = 0;
    };
    std::map<Region, Counts> regions;
    for (const MeshComponent& component : report_.components) ++regions[component.region].have;
    for (const ListedComponent& listed : listed_) ++regions[listed.component.region].in_domain;
    for (const Component& component : ledger.missing) ++regions[component.region].missing;
    regions.erase(kOutside);
    Tally tally{"audit.component_count"};
    for (const auto& [region, counts] : regions) {
      const std::string of_region = regions.size() == 1 ? "" : " of region " + std::to_string(region);
      compare(counts.have, counts.in_domain - counts.missing, counts.in_domain, of_region, tally);
    }
    if (!report_.components.empty()) tally.places = {report_.components.back().box_mm.center()};
    record(tally, report_);
  }

  // Counts what is not explained by the components that are known to be missing.
  void compare(std::uint64_t have, std::uint64_t want, std::uint64_t in_domain, const std::string& of, Tally& tally) {
    if (have == want) return;
    tally.count += have > want ? have - want : want - have;
    tally.first += (tally.first.empty() ? "" : "; ") + std::to_string(have) + of + " in the mesh, " +
                   std::to_string(in_domain) + " in the domain";
  }

  AuditReport& report_;
  std::vector<ListedComponent> listed_;
  VertexPatches patches_;
  std::set<Patch> in_mesh_;
  bool knows_all_ = false;
  bool tells_apart_ = false;
  Tally missing_components_{"audit.component_missing"};
  Tally missing_cavities_{"audit.cavity_missing"};
};

}  // namespace

std::vector<VertexId> boundary_vertices(const TetMesh& mesh, const FaceMatch& match) {
  std::vector<std::uint8_t> on(mesh.vertices.size(), 0);
  for (const BoundaryFace& face : match.boundary) {
    for (const VertexId v : face.vertices) on[v] = 1;
  }
  std::vector<VertexId> vertices;
  for (VertexId v = 0; v < on.size(); ++v) {
    if (on[v] != 0) vertices.push_back(v);
  }
  return vertices;
}

void check_residuals(const TetMesh& mesh, const std::vector<VertexId>& vertices, const Domain& domain,
                     double max_residual, AuditReport& report) {
  std::vector<std::optional<double>> residuals(vertices.size());
  const auto look_at = [&](std::size_t begin, std::size_t end, Tally& off) {
    for (std::size_t i = begin; i < end; ++i) {
      residuals[i] = domain.residual_at(mesh.vertices[vertices[i]]);
      if (!residuals[i] || *residuals[i] <= max_residual) continue;
      off.hit(mesh.vertices[vertices[i]], [&] {
        return named("vertex", vertices[i]) + " by " + number_text(*residuals[i], 3) +
               " of the domain's scale, more than " + number_text(max_residual, 3);
      });
    }
  };
  const Tally off = parallel_tally("audit.off_boundary", vertices.size(), look_at);
  for (const auto& residual : residuals) {
    if (!residual) return;
    report.max_residual = std::max(report.max_residual.value_or(0), *residual);
  }
  record(off, report);
}

void check_circumcentres(const TetMesh& mesh, const Domain& domain, bool finding, AuditReport& report) {
  const auto look_at = [&](std::size_t begin, std::size_t end, Tally& tally) {
    std::vector<Point> places;
    std::vector<std::size_t> asked;  // of which tets
    for (std::size_t i = begin; i < end; ++i) {
      const auto quick = circumcentre<double>(mesh, mesh.tets[i]);
      if (!quick) continue;
      places.push_back(quick->place);
      asked.push_back(i);
    }
    std::vector<Region> found(places.size());
    domain.regions_at(places, found);
    std::size_t next = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Region region = mesh.tet_regions[i];
      // In doubles it is as near as rounding may have moved it.
      if (next < asked.size() && asked[next] == i && found[next++] == region) continue;
      const auto center = circumcentre<long double>(mesh, mesh.tets[i]);
      if (!center || region_near(domain, *center, region)) continue;
      tally.hit(center->place, [&] { return named("tet", i) + " of region " + std::to_string(region); });
    }
  };
  const Tally astray = parallel_tally("audit.circumcentre", mesh.tets.size(), look_at);
  report.circumcentres_astray = astray.count;
  if (finding) record(astray, report);
}

void check_ledgers(const TetMesh& mesh, const FaceMatch& match, const std::vector<VertexId>& boundary,
                   const std::vector<std::uint32_t>& component_of, const OutsideSurfaces& outside, const Domain& domain,
                   AuditReport& report) {
  LedgerCheck ledger(mesh, boundary, domain, report);
  ledger.run();
  ledger.compare_handles(match, component_of, outside);
}

}  // namespace scantet::auditing
