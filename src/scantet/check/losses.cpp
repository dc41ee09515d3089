#include "scantet/check/losses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "scantet/check/audit_impl.h"

namespace scantet {
namespace {

constexpr std::array<std::string_view, 8> kLosses{
    "audit.curve",       "audit.boundary_edge", "audit.boundary_vertex", "audit.joined_label",
    "audit.split_label", "audit.broken_label",  "audit.cavity_missing",  "audit.cavity_joined"};

constexpr std::array<std::string_view, 9> kCounted{
    "audit.boundary_edge",   "audit.boundary_vertex",  "audit.component_missing",
    "audit.component_count", "audit.component_joined", "audit.component_split",
    "audit.cavity_missing",  "audit.cavity_count",     "audit.cavity_joined"};  // audit.handles counts components

constexpr double kSmallPart = 4;  // sizes

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& codes, const std::string& code) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

std::uint64_t difference_of(const HandleDifference& handles) {
  const auto in_domain = handles.component.handles();
  const std::int64_t difference = in_domain ? *in_domain - handles.handles() : *handles.component.euler - handles.euler;
  return static_cast<std::uint64_t>(std::abs(difference));
}

/// Places of the findings with one of the codes.
template <std::size_t N>
std::vector<Point> places_of(const AuditReport& report, const std::array<std::string_view, N>& codes) {
  std::vector<Point> places;
  for (const Finding& finding : report.findings) {
    if (is_one_of(codes, finding.code)) places.insert(places.end(), finding.places.begin(), finding.places.end());
  }
  return places;
}

/// Of these points, some that are no nearer to each other than the size: as many as elements find place along them.
std::vector<Point> thinned(const std::vector<Point>& points, const SizingField& size) {
  std::vector<Point> kept;
  for (const Point& p : points) {
    const double size_mm = size.size_at(p);
    const auto is_near = [&](const Point& q) { return squared_distance(p, q) < size_mm * size_mm; };
    if (std::none_of(kept.begin(), kept.end(), is_near)) kept.push_back(p);
  }
  return kept;
}

/// The middles of equal cells of a box, each edge of which is at most that long.
void add_places_in(const Box& box, double most_mm, std::vector<Point>& places) {
  const Vec extent = box.extent();
  std::array<int, 3> cells{};
  Vec edge;
  for (int axis = 0; axis < 3; ++axis) {
    cells[axis] = std::max(1, static_cast<int>(std::ceil(extent[axis] / most_mm)));
    edge[axis] = extent[axis] / cells[axis];
  }
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        places.push_back(box.min + Vec{(i + 0.5) * edge.x, (j + 0.5) * edge.y, (k + 0.5) * edge.z});
      }
    }
  }
}

/// At points all along it.
bool is_in_region(const NarrowWay& way, const Domain& domain) {
  constexpr int kPoints = 32;
  const auto& [a, b] = way.segment;
  for (int n = 0; n <= kPoints; ++n) {
    if (domain.region_at(a + double(n) / kPoints * (b - a)) != way.region) return false;
  }
  return true;
}

/// What the audit finds of a mesh up to its boundary.
struct Looks {
  AuditReport report;
  auditing::FaceMatch match;
  std::vector<std::uint32_t> component_of;
  auditing::OutsideSurfaces outside;
};

/// Return: empty if the arrays are not whole.
std::optional<Looks> look_at(const TetMesh& mesh) {
  AuditReport report;
  if (!auditing::check_arrays(mesh, report)) return std::nullopt;
  const bool all_positive = auditing::check_elements(mesh, report).all_positive;
  auditing::FaceMatch match = auditing::match_faces(mesh, TetStars(mesh), all_positive, report);
  std::vector<std::uint32_t> component_of = auditing::list_components(mesh, match, report);
  auditing::OutsideSurfaces outside = auditing::check_boundary(mesh, match, component_of, report);
  return Looks{std::move(report), std::move(match), std::move(component_of), std::move(outside)};
}

}  // namespace

RegionLosses find_losses(const TetMesh& mesh, const Domain& domain, const RegionGrid& grid, const SizingField& size) {
  std::optional<Looks> looks = look_at(mesh);
  if (!looks) return {};
  auto& [report, match, component_of, outside] = *looks;
  auditing::check_regions(mesh, match, component_of, outside, grid, report);
  auditing::check_curves(mesh, match, auditing::boundary_vertices(mesh, match), domain, &size, report);
  RegionLedger& ledger = *report.region_ledger;
  std::copy_if(ledger.contacts.begin(), ledger.contacts.end(), std::back_inserter(ledger.broken),
               [&](const NarrowWay& way) { return is_in_region(way, domain); });
  std::vector<Point> places = places_of(report, kLosses);
  const std::vector<Point> missed = thinned(ledger.missed, size);
  places.insert(places.end(), missed.begin(), missed.end());
  return {std::move(places), std::move(ledger.broken)};
}

LossCount count_losses(const TetMesh& mesh, const Domain& domain, const SizingField& size) {
  std::optional<Looks> looks = look_at(mesh);
  if (!looks) return {};
  auto& [report, match, component_of, outside] = *looks;
  const std::vector<VertexId> boundary = auditing::boundary_vertices(mesh, match);
  auditing::measure_components(mesh, component_of, report);
  auditing::check_ledgers(mesh, match, boundary, component_of, outside, domain, report);
  auditing::check_curves(mesh, match, boundary, domain, &size, report);
  LossCount losses;
  losses.small_parts = places_of(report, std::array<std::string_view, 2>{"audit.cavity_missing", "audit.cavity_count"});
  losses.curve_gaps = places_of(report, std::array<std::string_view, 1>{"audit.curve"});
  for (const Finding& finding : report.findings) losses.count += is_one_of(kCounted, finding.code) ? finding.count : 0;
  if (!report.handle_ledger) return losses;
  losses.missing_euler = report.handle_ledger->expected_euler - report.handle_ledger->euler;
  for (const HandleDifference& handles : report.handle_ledger->different) {
    losses.count += difference_of(handles);
    const Component& part = handles.component;
    const double size_mm = size.size_at(part.witness);
    if (part.box_mm.diagonal() > kSmallPart * size_mm) continue;
    losses.small_parts.push_back(part.witness);
    add_places_in(part.box_mm, size_mm / 2, losses.in_small_parts);
  }
  return losses;
}

}  // namespace scantet
