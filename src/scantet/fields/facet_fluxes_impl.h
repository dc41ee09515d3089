// Fluxes of a scan through facets. Private to fields/.
//
// By the divergence theorem the integral of a function over a tet is the sum, over its facets, of the integral of an
// antiderivative along x over the facet as seen along x. All that is to be cut by the planes of the grid is triangles,
// and what is got of one serves the tets on both sides. The antiderivative of the trilinear map has no bend in its
// slope along y or z within a cell's row along x; at each plane across x that the facet meets there, half the square of
// x past the plane is added, times what the slope along x rises there.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/field/scan.h"
#include "scantet/fields/facet_slices_impl.h"
#include "scantet/fields/fan_integrals_impl.h"

namespace scantet {

/// Of the antiderivatives that begin at two planes across x, one for each of its tets.
struct FacetFlux {
  std::array<int, 2> start{};
  std::array<double, 2> flux{};
};

/// Fluxes through many facets of one scan.
template <class Voxel>
class FacetFluxes {
 public:
  FacetFluxes(const Scan& scan, const Voxel* voxels)
      : size_(scan.size),
        voxels_(voxels),
        edges_{0, scan.size[0], std::ptrdiff_t{scan.size[0]} * scan.size[1],
               std::ptrdiff_t{scan.size[0]} * (scan.size[1] + 1)} {}

  /// corners: in index space, in the box of voxel centres. start: from 0 to the last but one plane across x. The flux
  /// is positive along x if the corners turn from y to z. Return: the facet's number.
  std::uint32_t add(const std::array<Vec, 3>& corners, const std::array<int, 2>& start) {
    facet_ = static_cast<std::uint32_t>(fluxes_.size());
    fluxes_.push_back({start, {}});
    std::array<FacetCorner, 4> triangle;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec& p = corners[std::min<std::size_t>(i, 2)];
      triangle[i] = {p.x, p.y, p.z};
    }
    slice<2>({triangle.data(), 3}, size_[2] - 2, [&](const FacetPiece& slab, int k) {
      slice<1>(slab, size_[1] - 2, [&](const FacetPiece& piece, int j) { add_column(piece, j, k); });
    });
    return facet_;
  }
  /// To be called once all are there.
  void finish() {
    finish_columns();
    finish_bends();
  }
  const FacetFlux& of(std::uint32_t number) const { return fluxes_[number]; }

 private:
  void add_column(const FacetPiece& piece, int j, int k) {
    double low = piece.corners[0].x;
    double high = low;
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < piece.count; ++i) {
      const double x = piece.corners[i].x;
      high = std::max(high, x);
      if (x < low) {
        low = x;
        lowest = i;
      }
    }
    const int cell = std::min(static_cast<int>(low), size_[0] - 2);
    put(columns_, piece, {cell, j, k}, [&] { finish_columns(); });
    if (high <= cell + 1 || cell + 2 == size_[0]) return;
    FacetShrinking above(piece, lowest);
    for (int plane = cell + 1; plane < high && plane + 1 < size_[0]; ++plane) {
      put(bends_, above.past(plane), {plane, j, k}, [&] { finish_bends(); });
    }
  }

  template <class Full>
  void put(Fans& fans, const FacetPiece& piece, const std::array<int, 3>& cell, const Full& when_full) {
    const auto set = [](std::array<FanLane, 3>& lanes, std::size_t i, const FacetCorner& p) {
      lanes[0][i] = p.x;
      lanes[1][i] = p.y;
      lanes[2][i] = p.z;
    };
    for (std::size_t at = 1; at + 1 < piece.count; at += 2) {
      const std::size_t i = fans.count++;
      set(fans.o, i, piece.corners[0]);
      set(fans.a, i, piece.corners[at]);
      set(fans.b, i, piece.corners[at + 1]);
      set(fans.c, i, piece.corners[at + 2]);
      for (std::size_t axis = 0; axis < 3; ++axis) fans.cell[axis][i] = cell[axis];
      fans.facet[i] = facet_;
      if (fans.count == kFans) when_full();
    }
  }

  /// The voxel at the lowest corner of a fan's cell.
  const Voxel* voxel_of(const Fans& fans, std::size_t i) const {
    return voxels_ + (std::ptrdiff_t{fans.cell[2][i]} * edges_[2] + std::ptrdiff_t{fans.cell[1][i]} * edges_[1] +
                      fans.cell[0][i]);
  }
  static double value(const Voxel* voxel) { return static_cast<double>(*voxel); }

  void finish_columns() {
    ColumnHeights& heights = heights_;
    for (std::size_t i = 0; i < columns_.count; ++i) {
      const Voxel* voxel = voxel_of(columns_, i);
      const int cell = columns_.cell[0][i];
      const int back = cell > 0 ? 1 : 0;  // nothing begins before the first plane
      for (std::size_t edge = 0; edge < 4; ++edge) {
        heights.before[edge][i] = value(voxel + edges_[edge] - back);
        heights.at[edge][i] = value(voxel + edges_[edge]);
        heights.after[edge][i] = value(voxel + edges_[edge] + 1);
      }
      const FacetFlux& facet = fluxes_[columns_.facet[i]];
      for (std::size_t side = 0; side < 2; ++side) heights.start[side][i] = facet.start[side] - cell;
    }
    integrate_columns(columns_, heights, integrals_);
    for (std::size_t i = 0; i < columns_.count; ++i) {
      FacetFlux& facet = fluxes_[columns_.facet[i]];
      for (std::size_t side = 0; side < 2; ++side) {
        const double start = heights.start[side][i];
        facet.flux[side] += integrals_.integral[side][i];
        if (start < -1 || start > 1) facet.flux[side] += from_afar(i, static_cast<int>(start));
      }
    }
    columns_.count = 0;
  }

  /// What an antiderivative gathers from so many steps away up to one step from the cell.
  double from_afar(std::size_t i, int start) const {
    const Voxel* voxel = voxel_of(columns_, i);
    const auto at = [&](int step) {
      double all = 0;
      for (std::size_t edge = 0; edge < 4; ++edge)
        all += integrals_.weight[edge][i] * value(voxel + edges_[edge] + step);
      return all;
    };
    const int way = start < 0 ? -1 : 1;
    double all = 0.5 * (at(way) + at(start));
    for (int step = 2 * way; step != start; step += way) all += at(step);
    return -way * all;
  }

  void finish_bends() {
    for (std::size_t i = 0; i < bends_.count; ++i) {
      const Voxel* voxel = voxel_of(bends_, i);
      for (std::size_t edge = 0; edge < 4; ++edge) {
        const Voxel* v = voxel + edges_[edge];
        bend_heights_[edge][i] = (value(v + 1) - value(v)) - (value(v) - value(v - 1));
      }
    }
    integrate_bends(bends_, bend_heights_, bend_integrals_);
    for (std::size_t i = 0; i < bends_.count; ++i) {
      for (double& flux : fluxes_[bends_.facet[i]].flux) flux += bend_integrals_[i];
    }
    bends_.count = 0;
  }

  std::array<int, 3> size_;
  const Voxel* voxels_;
  std::array<std::ptrdiff_t, 4> edges_;  // from a cell's lowest corner to its edges along x
  std::vector<FacetFlux> fluxes_;
  std::uint32_t facet_ = 0;
  Fans columns_{}, bends_{};
  ColumnHeights heights_{};
  ColumnIntegrals integrals_{};
  std::array<FanLane, 4> bend_heights_{};
  FanLane bend_integrals_{};
};

}  // namespace scantet
