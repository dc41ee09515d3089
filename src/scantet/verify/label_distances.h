// How far the boundaries of a mesh's regions are from those of a label map's, both ways.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/verify/box_tree.h"
#include "scantet/verify/label_cells.h"
#include "scantet/verify/label_mesh.h"

namespace scantet::verify {

/// A distance that is proved, and where it is so.
struct ProvedDistance {
  std::optional<double> upper_mm;  ///< none: not bounded
  Point place;
};

class LabelDistances {
 public:
  LabelDistances(const TetMesh& mesh, const MeshRegions& regions, const LabelSource& labels);

  /// Of each region's boundary in the mesh, from its boundary in the label map.
  std::map<Region, ProvedDistance> from_mesh(const Progress& progress) const;
  /// Of each region's boundary in the label map, from its boundary in the mesh.
  std::map<Region, ProvedDistance> from_field(const Progress& progress) const;

 private:
  struct Surface {
    std::vector<std::uint32_t> faces;  // of MeshRegions::faces
    BoxTree tree;
  };
  struct Sample;
  void try_at(const Point& from, const Vec& along, double step, Sample& sample) const;
  void try_ways(const Point& from, const Vec& across, Sample& sample) const;
  void try_nodes(const Point& from, Sample& sample) const;
  std::array<std::optional<double>, 2> bounds_of_face(const RegionFace& face) const;
  double distance_to(const Surface& surface, const Point& p, double enough) const;
  void bound_box(const LabelCellValues& fields, const Cell& cell, const Box& box, int depth,
                 std::map<Region, ProvedDistance>& worst) const;

  const TetMesh& mesh_;
  const MeshRegions& regions_;
  const LabelSource& labels_;
  IndexMap map_;
  std::map<Region, Surface> surfaces_;
  double margin_mm_ = 0;  // of a distance, by rounding
  double spacing_mm_;
};

}  // namespace scantet::verify
