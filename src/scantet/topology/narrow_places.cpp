// Nodes are classified by the signs around them, 64 at a time, and only those that may be narrow are looked at. Where
// heights are equal, as in a mask, every node of a thread is a place, for with fewer the thread could be lost. A sheet
// has no place there: it would ask for a fine sample of all of it, and it breaks less easily.
#include "scantet/topology/narrow_places.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/base/symmetric_matrix.h"
#include "scantet/field/run_sweep.h"
#include "scantet/field/sign_patterns.h"
#include "scantet/topology/trilinear_saddles.h"

namespace scantet {
namespace {

constexpr double kSmallestRadius = 0.05;  // of the smallest spacing

/// Of a symmetric matrix.
double largest_eigenvalue(const std::array<Vec, 3>& m) {
  return eigenvalue_form({m[0].x, m[1].y, m[2].z, m[0].y, m[0].z, m[1].z}).largest();
}

/// The distance t at which s + κ t²/2 reaches zero, if κ ≥ 0 leads there.
double reach(double s, double curvature) {
  return std::sqrt(2 * std::abs(s) / curvature);
}

class NarrowPlaces {
 public:
  NarrowPlaces(const HeightGrid& heights, const Frame& frame);
  /// Adds the low face across `axis` of cell (i, j, k), which is ambiguous, if it is a place.
  void add_face(int axis, int i, int j, int k);
  void add_body(int i, int j, int k, const CellHeights& corners);
  /// Adds the node if it is a place. differing: as in visit_narrow_nodes.
  void add_node(int i, int j, int k, unsigned differing);
  void add_component(const std::array<int, 3>& witness);
  std::vector<SizeHint> take() { return std::move(features_); }

 private:
  double neighbor_height(const std::array<int, 3>& node, int n) const;
  double nearest_crossing_mm(const std::array<int, 3>& node) const;
  void emit(const Vec& index, double radius_mm);

  const HeightGrid& heights_;
  Frame frame_;
  double spacing_mm_;
  std::array<Vec, 3> gradients_;  // of the three index coordinates, in world space
  std::vector<SizeHint> features_;
};

NarrowPlaces::NarrowPlaces(const HeightGrid& heights, const Frame& frame)
    : heights_(heights), frame_(frame), spacing_mm_(frame.min_spacing_mm()) {
  for (int axis = 0; axis < 3; ++axis) {
    gradients_[axis] =
        (1 / frame.determinant_mm3()) * cross(frame.column((axis + 1) % 3), frame.column((axis + 2) % 3));
  }
}

void NarrowPlaces::add_face(int axis, int i, int j, int k) {
  // Heights at the corners of the face, moved by `step` across it.
  const auto corners = [&](int step) {
    std::array<double, 4> h;
    for (int n = 0; n < 4; ++n) {
      const std::array<int, 3> node = low_face_node({i, j, k}, axis, n, step);
      h[n] = heights_.height(node[0], node[1], node[2]);
    }
    return h;
  };
  const FaceSaddle saddle = face_saddle(corners(0));
  const double s = saddle.value;
  const double ahead = saddle.at_its_place(corners(1)) - s;
  const double behind = saddle.at_its_place(corners(-1)) - s;
  if ((ahead > 0) != (behind > 0)) return;

  const auto [u_axis, v_axis] = face_axes(axis);
  const Vec& along_u = frame_.column(u_axis);
  const Vec& along_v = frame_.column(v_axis);
  const double area2 = squared_length(cross(along_u, along_v));
  // The eigenvalues of the twist in the face's world metric are (±|u||v| - u·v) twist / |u × v|². The one that leads to
  // the level counts.
  const double toward = s > 0 ? -1 : 1;
  const double skew = toward * dot(along_u, along_v) * (saddle.twist > 0 ? 1 : -1);
  const double curvature = std::abs(saddle.twist) * (length(along_u) * length(along_v) - skew) / area2;
  double radius = reach(s, curvature);
  if ((ahead > 0) == (toward > 0)) {
    const double step_mm = std::abs(frame_.determinant_mm3()) / std::sqrt(area2);
    radius = std::min(radius, std::abs(s) / std::max(std::abs(ahead), std::abs(behind)) * step_mm);
  }
  emit(saddle.index({i, j, k}, axis), radius);
}

void NarrowPlaces::add_body(int i, int j, int k, const CellHeights& corners) {
  std::array<Saddle, 2> saddles;
  const int count = body_saddles(corners, saddles);
  for (int n = 0; n < count; ++n) {
    const Saddle& saddle = saddles[n];
    const double toward = saddle.value > 0 ? -1 : 1;
    std::array<Vec, 3> hessian{};
    for (int axis = 0; axis < 3; ++axis) {
      const Vec& p = gradients_[(axis + 1) % 3];
      const Vec& q = gradients_[(axis + 2) % 3];
      const double mixed = toward * saddle.mixed[axis];
      for (int row = 0; row < 3; ++row) hessian[row] = hessian[row] + mixed * (p[row] * q + q[row] * p);
    }
    emit(Vec{double(i), double(j), double(k)} + saddle.position, reach(saddle.value, largest_eigenvalue(hessian)));
  }
}

void NarrowPlaces::add_node(int i, int j, int k, unsigned differing) {
  const std::array<int, 3> node{i, j, k};
  const double here = std::abs(heights_.height(i, j, k));
  // Along a thread, and within a sheet, the neighbours have the node's own sign. It is a place only if they are farther
  // from the level.
  const bool is_sheet = std::popcount(differing) == 2;
  for (int n = 0; n < 6; ++n) {
    if (differing >> n & 1) continue;
    const double there = std::abs(neighbor_height(node, n));
    if (is_sheet ? there <= here : there < here) return;
  }
  emit({double(i), double(j), double(k)}, nearest_crossing_mm(node));
}

void NarrowPlaces::add_component(const std::array<int, 3>& witness) {
  emit({double(witness[0]), double(witness[1]), double(witness[2])}, nearest_crossing_mm(witness));
}

/// The height of the node's neighbour n, in the order of the bits of visit_narrow_nodes.
double NarrowPlaces::neighbor_height(const std::array<int, 3>& node, int n) const {
  const std::array<int, 3> there = axis_neighbor(node, n);
  return heights_.height(there[0], there[1], there[2]);
}

/// The distance to the level set along the node's six edges; infinite if it crosses none.
double NarrowPlaces::nearest_crossing_mm(const std::array<int, 3>& node) const {
  const double here = heights_.height(node[0], node[1], node[2]);
  double nearest = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 6; ++n) {
    const double there = neighbor_height(node, n);
    if ((there > 0) != (here > 0)) nearest = std::min(nearest, here / (here - there) * frame_.spacing_mm(n / 2));
  }
  return nearest;
}

void NarrowPlaces::emit(const Vec& index, double radius_mm) {
  if (!(radius_mm < spacing_mm_)) return;
  features_.push_back({frame_.to_world(index), std::max(radius_mm, kSmallestRadius * spacing_mm_)});
}

/// Adds the places of the layers begin … end - 1 of nodes, and of the cells above them.
void sweep(const HeightGrid& heights, int begin, int end, NarrowPlaces& places) {
  std::array<SignLayer, 3> layers{SignLayer(heights), SignLayer(heights), SignLayer(heights)};
  const auto layer = [&](int k) -> SignLayer& { return layers[(k + 3) % 3]; };
  const auto read = [&](int k) {
    for (int row = 0; row < layer(k).rows; ++row) layer(k).read_row(heights, row, k);
  };
  read(begin - 1);
  read(begin);
  for (int k = begin; k < end; ++k) {
    read(k + 1);
    visit_narrow_nodes(layer(k - 1), layer(k), layer(k + 1),
                       [&](int i, int j, unsigned differing) { places.add_node(i, j, k, differing); });
    visit_mixed_cells(layer(k), layer(k + 1), [&](int i, int j, unsigned pattern) {
      const std::uint8_t open = open_questions(pattern);
      for (int axis = 0; axis < 3; ++axis) {
        if (open >> axis & 1) places.add_face(axis, i, j, k);
      }
      if (open & kBodyOpen) places.add_body(i, j, k, heights.corners(i, j, k));
    });
  }
}

}  // namespace

std::vector<SizeHint> narrow_places(const HeightGrid& heights, const Frame& frame,
                                    const std::vector<std::array<int, 3>>& components) {
  constexpr std::size_t kSlab = 16;  // layers of the image; the padding has no saddle
  const std::size_t layers = heights.size()[2];
  std::vector<std::vector<SizeHint>> found((layers + kSlab - 1) / kSlab);
  parallel_for(layers, kSlab, [&](std::size_t begin, std::size_t end) {
    NarrowPlaces places(heights, frame);
    sweep(heights, static_cast<int>(begin), static_cast<int>(end), places);
    found[begin / kSlab] = places.take();
  });
  NarrowPlaces places(heights, frame);
  for (const std::array<int, 3>& node : components) places.add_component(node);
  found.push_back(places.take());

  std::vector<SizeHint> all;
  for (const std::vector<SizeHint>& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace scantet
