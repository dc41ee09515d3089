// Each facet turns over the nodes beyond it, of the rows that pass through it: first the bit where that begins alone,
// then, row by row, all from there on.
#include "scantet/topology/nodes_within.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

/// The first and the last whole number from low to high that is a node's; none if first > last.
struct NodeRange {
  NodeRange(double low, double high, int size)
      : first(static_cast<int>(std::ceil(std::clamp(low, 0.0, double(size))))),
        last(static_cast<int>(std::floor(std::clamp(high, -1.0, double(size - 1))))) {}
  int first;
  int last;
};

/// Facets as rows along x see them, in the grid's indices.
class FacetRows {
 public:
  FacetRows(const std::vector<Vec>& vertices, NodeBits& bits) : vertices_(vertices), bits_(bits) {}

  void add(const Triangle& facet) {
    const auto [y_low, y_high] = bounds(facet, &Vec::y);
    const auto [z_low, z_high] = bounds(facet, &Vec::z);
    const NodeRange js(y_low, y_high, bits_.size()[1]);
    const NodeRange ks(z_low, z_high, bits_.size()[2]);
    for (int k = ks.first; k <= ks.last; ++k) {
      for (int j = js.first; j <= js.last; ++j) meet(facet, j, k);
    }
  }

 private:
  struct Side {
    double area;   ///< of the edge and the row, twice, with the edge's direction
    bool is_left;  ///< of the row
  };

  std::pair<double, double> bounds(const Triangle& facet, double Vec::*axis) const {
    return std::minmax({vertices_[facet[0]].*axis, vertices_[facet[1]].*axis, vertices_[facet[2]].*axis});
  }

  /// On which side of the edge the row is: the same answer for all facets that have the edge. What is 0 is told by a
  /// row that is a little farther along y, and far less along z.
  Side side_of(VertexId a, VertexId b, double j, double k) const {
    const bool turned = b < a;
    const Vec& from = vertices_[turned ? b : a];
    const Vec& to = vertices_[turned ? a : b];
    const double along_y = to.y - from.y;
    const double along_z = to.z - from.z;
    const auto apart = [&](const Vec& v) { return std::abs(v.y - j) + std::abs(v.z - k); };
    const Vec& near = apart(to) < apart(from) ? to : from;  // the smaller its differences, the less is rounded
    double area = along_y * (k - near.z) - along_z * (j - near.y);
    const bool is_left = area > 0 || (area == 0 && (along_z < 0 || (along_z == 0 && along_y > 0)));
    if (turned) area = -area;
    return {area, is_left != turned};
  }

  void meet(const Triangle& facet, int j, int k) {
    std::array<Side, 3> sides;
    for (std::size_t n = 0; n < 3; ++n) sides[n] = side_of(facet[(n + 1) % 3], facet[(n + 2) % 3], j, k);
    if (sides[0].is_left != sides[1].is_left || sides[0].is_left != sides[2].is_left) return;
    double x = 0;
    double area = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      x += sides[n].area * vertices_[facet[n]].x;
      area += sides[n].area;
    }
    const auto [low, high] = bounds(facet, &Vec::x);
    turn_over(area == 0 ? low : std::clamp(x / area, low, high), j, k);
  }

  /// All nodes of the row from x on.
  void turn_over(double x, int j, int k) {
    const int size = bits_.size()[0];
    const auto bit = static_cast<std::size_t>(std::ceil(std::clamp(x, 0.0, double(size)))) + 1;
    std::atomic_ref word(bits_.row(j, k)[bit / 64]);
    word.fetch_xor(std::uint64_t{1} << (bit % 64), std::memory_order_relaxed);
  }

  const std::vector<Vec>& vertices_;
  NodeBits& bits_;
};

/// Has each bit be the parity of those up to it.
void sum_up(std::uint64_t* row, int words) {
  std::uint64_t before = 0;
  for (int w = 0; w < words; ++w) {
    for (unsigned shift = 1; shift < 64; shift *= 2) row[w] ^= row[w] << shift;
    row[w] ^= before;
    before = row[w] >> 63 != 0 ? ~std::uint64_t{0} : 0;
  }
}

}  // namespace

NodeBits::NodeBits(const std::array<int, 3>& size) : size_(size), words_((size[0] + 2 + 63) / 64) {
  bits_.resize(static_cast<std::size_t>(words_) * static_cast<std::size_t>(size[1]) *
               static_cast<std::size_t>(size[2]));
}

NodeBits nodes_within(const TriangleSurface& surface, const Frame& frame, const std::array<int, 3>& size) {
  constexpr std::size_t kFacets = 2048;
  std::vector<Vec> vertices(surface.vertices.size());
  parallel_for(vertices.size(), kFacets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) vertices[v] = frame.to_index(surface.vertices[v]);
  });
  NodeBits bits(size);
  parallel_for(surface.facets.size(), kFacets, [&](std::size_t begin, std::size_t end) {
    FacetRows rows(vertices, bits);
    for (std::size_t f = begin; f < end; ++f) rows.add(surface.facets[f]);
  });
  parallel_for(static_cast<std::size_t>(size[2]), 1, [&](std::size_t layer, std::size_t) {
    for (int j = 0; j < size[1]; ++j) sum_up(bits.row(j, static_cast<int>(layer)), bits.words());
  });
  return bits;
}

}  // namespace scantet
