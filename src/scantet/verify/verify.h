// The certificate: whether a mesh, from whatever program, is the scan that it is said to be. docs/certificate.md has
// the theorem, its proof, and what each grade means.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// How much is proved.
enum class CertificateGrade {
  certified,     ///< the mesh's boundary is isotopic to the level set, and no farther from it than the bound
  bounded,       ///< distance bounded both ways, the same components, cavities and handles; not everywhere a collar
  undecided,     ///< nothing wrong was found, but not all of this could be proved
  not_the_scan,  ///< something is proved to be wrong
};

/// "certified", "bounded", "undecided" or "not the scan".
std::string name_of(CertificateGrade grade);

/// What is wrong, or could not be decided, and where.
struct VerifyFinding {
  std::string code;       ///< stable: "tet.not_positive", "vertex.off_level", "component.missing" …
  std::string what;       ///< a sentence without its full stop
  Point place;            ///< one of the places, world mm
  std::size_t count = 1;  ///< how many such places there are
  bool is_wrong = true;   ///< proved to be wrong
  bool bounded = true;    ///< not wrong, and no obstacle to the grade bounded; of no meaning if is_wrong
  bool is_found = false;  ///< proved, but not wrong for it; else, if not wrong, it could not be decided
};

/// A distance between a lower bound, which a place shows, and an upper one, which is proved. Places are world mm.
struct VerifiedDistance {
  double lower_mm = 0;             ///< 0: none was found
  Point lower_place;               ///< where it is at least so far; of no meaning if that is 0
  std::optional<double> upper_mm;  ///< none: could not be bounded
  Point upper_place;               ///< where the upper bound is that large, or could not be found
};

/// Components of the inside, cavities, and the Euler number of the boundary between them.
struct VerifiedInvariants {
  std::int64_t components = 0;
  std::int64_t cavities = 0;
  std::int64_t euler = 0;  ///< of the whole boundary: the sum of 2 - 2·genus over its surfaces
  bool is_known = true;    ///< false: the field is at the level in nodes or saddles, so that it depends on ties
  std::int64_t handles() const { return components + cavities - euler / 2; }  ///< the sum of the genera
};

/// A part of the boundary of which it is not proved that it follows the level set.
struct UndecidedPlace {
  Box box;             ///< world, mm
  std::string reason;  ///< "value", "slope", "fold", "crowded" or "vertex"
};

/// A component of the scan that the mesh does not have, or a cavity that it fills, as was allowed.
struct LeftOutPart {
  bool is_cavity = false;
  Point place;            ///< its voxel that is farthest from the level, world mm
  double volume_mm3 = 0;  ///< of its voxels
};

/// How far a facet is from the level set at most.
struct FacetBound {
  Triangle facet;   ///< vertices of the mesh, TetMesh::vertices
  double bound_mm;  ///< proved; -1: not bounded
};

/// What is proved of one region of a label map's mesh.
struct VerifiedRegion {
  Region region = kOutside;
  std::uint64_t voxels = 0;          ///< of the label map
  std::uint64_t voxels_kept = 0;     ///< whose centres are in this region of the mesh, too
  std::uint64_t voxels_on_face = 0;  ///< whose centres lie on the boundary of the mesh: in none
  /// Parts of the label map's region that hold the centre of a voxel: at least, and at most.
  std::array<std::int64_t, 2> field_components{};
  std::int64_t mesh_components = 0;
  VerifiedDistance mesh_to_field;  ///< of the region's boundary in the mesh from that in the label map
  VerifiedDistance field_to_mesh;
  std::array<double, 2> mesh_volume_mm3{};   ///< between these
  std::array<double, 2> field_volume_mm3{};  ///< between these
};

/// What is proved of a mesh.
struct Certificate {
  CertificateGrade grade = CertificateGrade::undecided;
  std::vector<VerifyFinding> findings;

  std::size_t tets = 0;              ///< of the mesh
  std::size_t facets = 0;            ///< of the mesh's boundary; of a label map, of those of its regions
  std::size_t facets_certified = 0;  ///< with a collar, and disjoint from all others'
  std::size_t facets_at_border = 0;  ///< in the layer of cells that closes the level set beyond the outermost voxels
  double area_mm2 = 0;               ///< of the facets; 0 of a label map
  double area_certified_mm2 = 0;     ///< of those certified
  std::vector<UndecidedPlace> undecided;  ///< the largest, at most VerifyOptions::most_places

  VerifiedDistance mesh_to_level;
  VerifiedDistance level_to_mesh;
  VerifiedInvariants field;  ///< without what was left out
  VerifiedInvariants mesh;
  std::size_t components_left_out = 0;       ///< as was allowed
  std::size_t cavities_filled = 0;           ///< as was allowed
  std::vector<LeftOutPart> left_out;         ///< these, the largest first, at most VerifyOptions::most_places
  std::array<double, 2> mesh_volume_mm3{};   ///< between these
  std::array<double, 2> field_volume_mm3{};  ///< between these
  std::vector<FacetBound> bounds;            ///< of all facets, if asked for
  /// Of a label map, ascending, kOutside among them; otherwise empty. Then there are no collars, distances are the
  /// largest of all regions and without lower bounds, and of `field` and `mesh` the components alone mean something: of
  /// all regions but kOutside.
  std::vector<VerifiedRegion> regions;
  /// Of a closed surface, which `field` and `level` mean then: there are no collars.
  bool is_of_surface = false;
  double seconds = 0;  ///< of wall time, that this took

  static constexpr std::size_t kMostPlaces = 1000;  ///< VerifyOptions::most_places by default
};

/// What the mesh may lack. Volumes are counted: voxels of the part times the volume of a voxel.
struct MayBeLeftOut {
  std::optional<std::uint64_t> all_but_components;  ///< components smaller than so many others; none or 0: no such
  double components_below_mm3 = 0;                  ///< components of less than this volume
  double cavities_below_mm3 = 0;                    ///< cavities of less than this volume may be filled
  /// Whether it may lack anything.
  bool any() const { return all_but_components || components_below_mm3 > 0 || cavities_below_mm3 > 0; }
};

/// What is asked of the mesh. Label maps and surfaces are verified by few of these: verify_labels(), verify_surface().
struct VerifyOptions {
  LevelSetSettings level;
  MayBeLeftOut left_out;
  /// Whether the object ends flat at the outermost voxel centres, instead of closing within one voxel beyond: the level
  /// set then closes within a millionth of a voxel. LevelSetSettings::outside is of no meaning then.
  bool is_capped = false;
  /// How far boundary vertices may be from the level set, mm; none: a thousandth of the smallest distance between
  /// voxels. A vertex of which that is not proved keeps the mesh from being certified.
  std::optional<double> vertex_tolerance_mm;
  /// The largest distance that a certified or bounded mesh may have from the level set, either way; none: any.
  std::optional<double> max_distance_mm;
  std::size_t most_places = Certificate::kMostPlaces;  ///< how many places of a kind are listed
  bool lists_facets = false;                           ///< Certificate::bounds is asked for
  /// Looks for collars alone: of the certificate only facets, areas, findings and undecided places mean something.
  bool only_collars = false;
  /// How often the heights of collars are changed where they fail; ≥ 0.
  int rounds = 8;
};

/// Verifies a mesh of one level of a scan. Nothing is used but the mesh's vertices and tets (what it says of its
/// boundary is not) and the scan's voxels and frame; no code of the mesher. All that is called proved is: by interval
/// arithmetic with outward rounding, or exactly. The field is trilinear between voxel centres, and goes on for one
/// voxel beyond the outermost ones to the outside value (LevelSetSettings::outside).
/// mesh: world mm, one region a tet, whichever; any tets, also such as overlap. progress: reported to as stage
/// "verify", and polled. Throws Error: input.no_tets, mesh.inconsistent (Fault::internal: not one region a tet, or a
/// vertex that is not there), input.level (as check_level()), input.range (values or coordinates beyond 1e50, or 64-bit
/// integers beyond 2^53), input.frame (axes that do not span space to rounding), input.too_large (2^32 voxels or more).
/// If progress.cancelled() became true, the outcome means nothing. Several threads; the outcome does not depend on how
/// many. Source: docs/certificate.md.
Certificate verify_mesh(const TetMesh& mesh, const Scan& scan, const VerifyOptions& options, Progress& progress);

/// Verifies a mesh of several levels, each by itself: the regions of the mesh in ascending order lie between one level
/// and the next, so that the tets of all regions but the first n are a mesh of level n + 1. Of one level all tets are a
/// mesh, of whatever regions. levels: at least one, the outermost first; options.level.level is not used. Return: one a
/// level, in their order. A mesh that has not as many regions as levels, if these are several, is not the scan
/// (mesh.regions). Throws as verify_mesh().
std::vector<Certificate> verify_levels(const TetMesh& mesh, const Scan& scan, const std::vector<double>& levels,
                                       const VerifyOptions& options, Progress& progress);

}  // namespace scantet
