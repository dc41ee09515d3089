// What is meshed, and at which criteria.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scantet/domain/sizing_field.h"
#include "scantet/image/level_set.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/refine/mesher.h"

namespace scantet::bench {

struct Case {
  std::string name;
  std::string scan;      ///< path of an image, or kHeadCtArchive
  bool labels = false;   ///< the image is a segmentation, and all its labels are meshed; `level` means nothing
  std::string formula;   ///< or the name of a surface that the plugin `implicit` knows
  std::string surface;   ///< or a polyhedron: a file of CGAL's data. All empty: the graded tanglecube
  double sharp_deg = 0;  ///< of a polyhedron: edges of this angle or more are followed, exactly; 0: none
  LevelSetSettings level;
  double size_mm = 0;  ///< the uniform σ; 0: graded, see tanglecube.h
  MesherOptions options;
  Optimize optimize = Optimize::none;    ///< exude: CGAL exudes, too; full: CGAL perturbs and exudes
  double min_dihedral_deg = 0;           ///< what optimising is to reach
  bool optimizing_alone = false;         ///< the figure compared is the time of that alone
  int runs = 1;                          ///< of each contestant, unless the caller says otherwise
  std::vector<std::string> contestants;  ///< that take part; empty: all

  bool has(const std::string& contestant) const;

  /// What is meshed, for tables: a path, "implicit:torus", "meshes/elephant.off" or "tanglecube".
  std::string object() const;

  /// Whether what it needs is on this machine; if not, `why` says what is missing.
  bool available(std::string& why) const;

  /// "σ = 2 mm, α = 1, dihedral angles ≥ 10°", as read in tables.
  std::string criteria() const;
};

/// All cases. volumes: the folder with skull.nrrd.
std::vector<Case> all_cases(const std::string& volumes);

/// What the plugins open for a case with a formula, a surface or labels.
std::string plugin_input(const Case& c);

/// The scan of a case that has one.
Scan open_scan(const Case& c);

/// The size as a field.
std::unique_ptr<SizingField> sizing(const Case& c);

}  // namespace scantet::bench
