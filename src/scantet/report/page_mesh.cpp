// Coordinates are single precision, relative to the bounding box: 1e-7 of the object, which no screen shows, and
// independent of how large or far away it is. Measures are taken from the exact coordinates before that.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>
#include <set>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/quality/measures.h"
#include "scantet/report/measures_impl.h"
#include "scantet/report/page_mesh_impl.h"

namespace scantet {
namespace {

std::vector<std::uint32_t> chosen_tets(const TetMesh& mesh, const QualitySummary& quality, std::size_t most_tets) {
  if (mesh.tets.size() > most_tets) {
    std::set<std::uint32_t> worst;
    for (const ReportWorst& list : report_worst_lists()) {
      for (const WorstTet& tet : quality.*list.tets) worst.insert(tet.tet);
    }
    return {worst.begin(), worst.end()};
  }
  std::vector<std::uint32_t> all(mesh.tets.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// Gives the vertices in use numbers of their own, in their order.
class Vertices {
 public:
  explicit Vertices(std::size_t count) : number_(count, 0) {}
  void use(VertexId v) { number_[v] = 1; }
  void number_used(const TetMesh& mesh, PageMesh& page) {
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] == 0) continue;
      number_[v] = next++;
      for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = (mesh.vertices[v][axis] - page.center[axis]) / page.scale_mm;
        page.coordinates.push_back(static_cast<float>(coordinate));
      }
    }
  }
  std::uint32_t operator[](VertexId v) const { return number_[v]; }

 private:
  std::vector<std::uint32_t> number_;
};

void place(const TetMesh& mesh, PageMesh& page) {
  Box box;
  for (const Point& p : mesh.vertices) box.extend(p);
  if (box.empty()) return;
  page.center = box.center();
  const double half = 0.5 * box.diagonal();
  if (half > 0) page.scale_mm = half;
}

std::uint8_t byte_of(const PageColoring& coloring, double value) {
  constexpr double kSteps = 255;
  const double share = (value - coloring.low) / (coloring.high - coloring.low);
  return static_cast<std::uint8_t>(std::lround(kSteps * std::clamp(share, 0.0, 1.0)));
}

// Lengths have no natural scale: it ends in the middle of those there are.
double usual(const Distribution& d) {
  constexpr std::size_t kMedian = 3;
  static_assert(kPercentiles[kMedian] == 50);
  return d.percentiles[kMedian] > 0 ? d.percentiles[kMedian] : 1;
}

std::vector<PageColoring> colorings_of(const TetMesh& mesh, const QualitySummary& quality,
                                       const std::vector<std::uint32_t>& chosen) {
  const double regular_deg = 70.528779365509308;  // acos(1/3)
  const double regular_radius_edge = std::sqrt(6.0) / 4;
  std::vector<PageColoring> colorings{
      {"min_dihedral_deg", "smallest dihedral angle", "°", 0, regular_deg, true, {}},
      {"inverse_aspect", "inverse aspect ratio", "", 0, 1.0 / 3, true, {}},
      {"radius_edge", "radius-edge ratio", "", regular_radius_edge, 2, false, {}},
      {"min_edge_length_mm", "shortest edge", " mm", 0, usual(quality.edge_length_mm), true, {}},
      {"min_height_mm", "least height", " mm", 0, usual(quality.min_height_mm), true, {}},
      {"scaled_jacobian", "scaled Jacobian", "", 0, 1, true, {}},
      {"largest_dihedral_deg", "largest dihedral angle", "°", regular_deg, 180, false, {}}};
  for (PageColoring& coloring : colorings) coloring.values.resize(chosen.size());
  constexpr std::size_t kTets = 8192;
  parallel_for(chosen.size(), kTets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[chosen[i]];
      const TetMeasures m =
          measure_tet(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]);
      const auto [smallest, largest] = std::minmax_element(m.dihedral_deg.begin(), m.dihedral_deg.end());
      const double shortest = *std::min_element(m.edge_mm.begin(), m.edge_mm.end());
      const double values[] = {*smallest,       m.inverse_aspect,  m.radius_edge, shortest,
                               m.min_height_mm, m.scaled_jacobian, *largest};
      for (std::size_t k = 0; k < colorings.size(); ++k) {
        colorings[k].values[i] = byte_of(colorings[k], values[k]);
      }
    }
  });
  return colorings;
}

void add_facets(const TetMesh& mesh, const std::vector<std::uint32_t>& chosen, const Vertices& vertices,
                PageMesh& page) {
  const bool all = chosen.size() == mesh.tets.size();
  const auto tets_of = [&](const std::vector<TetFace>& faces) {
    std::vector<std::uint32_t> tets;
    tets.reserve(mesh.boundary_facets.size());
    for (const TetFace& face : faces) tets.push_back(face.face < 4 ? face.tet : PageMesh::kNoTet);
    tets.resize(mesh.boundary_facets.size(), PageMesh::kNoTet);
    return tets;
  };
  for (const Triangle& facet : mesh.boundary_facets) {
    for (const VertexId v : facet) page.facets.push_back(vertices[v]);
  }
  page.facet_tets = tets_of(all ? faces_behind_facets(mesh) : std::vector<TetFace>{});
  if (!page.regions.empty()) page.facet_fronts = tets_of(all ? faces_before_facets(mesh) : std::vector<TetFace>{});
}

/// The regions that tets and facets are of, if there are several; more than the page can number count as one.
void add_regions(const TetMesh& mesh, const std::vector<std::uint32_t>& chosen, PageMesh& page) {
  std::vector<Region> regions = mesh.tet_regions;
  parallel_sort(regions, std::less<>());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  if (regions.size() < 2 || regions.size() >= PageMesh::kNoRegion) return;
  const auto place_of = [&](Region region) {
    const auto found = std::lower_bound(regions.begin(), regions.end(), region);
    const bool known = found != regions.end() && *found == region;
    return known ? static_cast<std::uint16_t>(found - regions.begin()) : PageMesh::kNoRegion;
  };
  for (const std::uint32_t tet : chosen) page.tet_regions.push_back(place_of(mesh.tet_regions[tet]));
  for (const auto& sides : mesh.facet_regions) {
    for (const Region region : sides) page.facet_sides.push_back(place_of(region));
  }
  page.regions = std::move(regions);
}

// Puts the bytes of numbers behind each other, little-endian.
class Bytes {
 public:
  template <class Number>
  void add(const std::vector<Number>& numbers) {
    static_assert(std::endian::native == std::endian::little, "otherwise the bytes must be turned round here");
    const auto* const first = reinterpret_cast<const std::uint8_t*>(numbers.data());
    bytes_.insert(bytes_.end(), first, first + numbers.size() * sizeof(Number));
  }
  const std::vector<std::uint8_t>& all() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

// Four digits for three bytes; what is missing to the last three is told by '='.
std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::size_t kTriples = 65536;
  const std::size_t triples = (bytes.size() + 2) / 3;
  std::string text(4 * triples, '=');
  parallel_for(triples, kTriples, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t count = std::min<std::size_t>(3, bytes.size() - 3 * i);
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 3; ++k) bits = bits << 8U | (k < count ? bytes[3 * i + k] : 0U);
      for (std::size_t k = 0; k <= count; ++k) text[4 * i + k] = kDigits[bits >> (18 - 6 * k) & 63U];
    }
  });
  return text;
}

PageMesh make_page_mesh(const TetMesh& mesh, const QualitySummary& quality, std::size_t most_tets) {
  PageMesh page;
  place(mesh, page);
  const std::vector<std::uint32_t> chosen = chosen_tets(mesh, quality, most_tets);
  Vertices vertices(mesh.vertices.size());
  for (const std::uint32_t i : chosen) {
    for (const VertexId v : mesh.tets[i]) vertices.use(v);
  }
  for (const Triangle& facet : mesh.boundary_facets) {
    for (const VertexId v : facet) vertices.use(v);
  }
  vertices.number_used(mesh, page);
  page.tets.reserve(4 * chosen.size());
  for (const std::uint32_t i : chosen) {
    for (const VertexId v : mesh.tets[i]) page.tets.push_back(vertices[v]);
  }
  add_regions(mesh, chosen, page);
  add_facets(mesh, chosen, vertices, page);
  page.colorings = colorings_of(mesh, quality, chosen);
  if (chosen.size() < mesh.tets.size()) page.numbers = chosen;
  return page;
}

void color_by_distance(const std::vector<double>& facets_off_mm, double most_mm, const std::string& title,
                       PageMesh& page) {
  PageColoring coloring{"distance_mm", title, " mm", 0, most_mm, false, {}};
  coloring.values.reserve(facets_off_mm.size());
  for (const double off_mm : facets_off_mm) coloring.values.push_back(byte_of(coloring, off_mm));
  page.facet_colorings.push_back(std::move(coloring));
}

void write_arrays(std::ostream& out, const PageMesh& mesh) {
  Bytes bytes;
  bytes.add(mesh.coordinates);
  bytes.add(mesh.tets);
  bytes.add(mesh.facets);
  bytes.add(mesh.facet_tets);
  bytes.add(mesh.facet_fronts);
  bytes.add(mesh.facet_sides);
  bytes.add(mesh.tet_regions);
  for (const PageColoring& coloring : mesh.colorings) bytes.add(coloring.values);
  for (const PageColoring& coloring : mesh.facet_colorings) bytes.add(coloring.values);
  out << base64(bytes.all());
}

}  // namespace scantet
