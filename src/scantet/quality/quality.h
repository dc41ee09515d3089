// The quality of a mesh as numbers: distributions of the measures, bounds and the worst elements.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

class SizingField;
class TetStars;

/// Counts in bins. Bin i holds edges[i] ≤ value < edges[i + 1]; values outside, infinite ones too, are counted in the
/// first or last bin.
struct Histogram {
  std::vector<double> edges;  ///< ascending, one more than counts
  std::vector<std::uint64_t> counts;
};

/// Which percentiles a Distribution has.
inline constexpr std::array<int, 7> kPercentiles{1, 5, 25, 50, 75, 95, 99};

/// How the values of one measure are distributed. The numbers are NaN if there are no values.
struct Distribution {
  std::uint64_t count = 0;
  std::uint64_t infinite = 0;                              ///< how many of them are infinite (of flat tets)
  double min = std::numeric_limits<double>::quiet_NaN();   ///< of the finite ones; infinite if there are none
  double max = std::numeric_limits<double>::quiet_NaN();   ///< infinite if one is
  double mean = std::numeric_limits<double>::quiet_NaN();  ///< of the finite ones; NaN if there are none
  /// One per kPercentiles, exact: the smallest value that at least p % of the values do not exceed.
  std::array<double, kPercentiles.size()> percentiles = [] {
    std::array<double, kPercentiles.size()> none{};
    none.fill(std::numeric_limits<double>::quiet_NaN());
    return none;
  }();
  Histogram histogram;
};

/// One of the worst elements.
struct WorstTet {
  std::uint32_t tet;  ///< index into TetMesh::tets
  Point place;        ///< its centroid, world mm, but where the list says otherwise
  double value;       ///< of the list's measure, in its unit
};

/// The share of one region in the mesh.
struct RegionVolume {
  Region region = kOutside;
  std::uint64_t tets = 0;
  double volume_mm3 = 0;          ///< sum of the signed volumes of its tets
  double min_dihedral_deg = 180;  ///< of its tets; 180 without any
  double max_dihedral_deg = 0;    ///< likewise; 0 without any

  /// Takes in more tets of the region; `region` stays.
  void add(const RegionVolume& more) {
    tets += more.tets;
    volume_mm3 += more.volume_mm3;
    min_dihedral_deg = more.min_dihedral_deg < min_dihedral_deg ? more.min_dihedral_deg : min_dihedral_deg;
    max_dihedral_deg = more.max_dihedral_deg > max_dihedral_deg ? more.max_dihedral_deg : max_dihedral_deg;
  }
};

inline constexpr std::array<double, 4> kSliverDeg{5, 10, 15, 20};  ///< dihedral angles under which tets are counted
inline constexpr std::size_t kWorstTets = 5;                       ///< elements in each list of the worst
inline constexpr double kWaveSpeedMPerS = 1500;                    ///< of sound in water and soft tissue

/// Bins: dihedral_deg 36 from 0 to 180; largest_dihedral_deg 24 from 60 to 180; inverse_aspect 40 from 0 to 1/3;
/// scaled_jacobian 40 from 0 to 1 (inverted tets count in the first); radius_edge 40 from √6/4 (the regular tet) to
/// 2, size_ratio and edge_size_ratio 40 from 0 to 1, stiffness_ratio 40 from 1 to 5, each with one more for all above,
/// which ends at the largest finite value but is as wide as the others at least; the others 40 from their smallest to
/// their largest finite value, or over a range of 1 from there if all are equal.
struct QualitySummary {
  Distribution dihedral_deg;          ///< six per tet
  Distribution largest_dihedral_deg;  ///< one per tet
  Distribution inverse_aspect;        ///< inradius / circumradius
  Distribution scaled_jacobian;       ///< TetMeasures::scaled_jacobian
  Distribution radius_edge;           ///< circumradius / shortest edge
  Distribution edge_length_mm;        ///< each edge of the mesh once
  Distribution min_height_mm;         ///< of each tet
  /// Least height / wave speed, µs: the longest step that an explicit solver may take for the sake of that tet, up to a
  /// factor of the solver's own.
  Distribution stable_time_step_us;
  double wave_speed_m_per_s = kWaveSpeedMPerS;  ///< that stable_time_step_us is for
  Distribution circumradius_mm;
  Distribution volume_mm3;                 ///< signed
  std::optional<Distribution> size_ratio;  ///< circumradius / σ(circumcentre): R3 asks for 1 at most; none without σ
  /// Each edge of the mesh once: length / the size asked for at its middle. None without such sizes.
  std::optional<Distribution> edge_size_ratio;
  Distribution stiffness_ratio;  ///< stiffness_ratio() of each tet (quality/measures.h): 1 is the regular tet
  /// What the elements do to the condition number of a stiffness matrix that is scaled by masses: its largest
  /// eigenvalue is at most that of the worst tet (Irons and Treharne 1971), stiffness_ratio() / volume^(2/3) but for a
  /// constant. This is that, over the same of the regular tet of median volume: how many times as large the condition
  /// number may be as on a mesh of such tets. Infinite with a flat tet; NaN without tets.
  double condition_factor = std::numeric_limits<double>::quiet_NaN();

  double min_facet_angle_deg = std::numeric_limits<double>::quiet_NaN();  ///< of the boundary facets
  double total_volume_mm3 = 0;                                            ///< sum of the signed volumes of all tets
  std::vector<RegionVolume> regions;                                      ///< ascending by region
  std::array<std::uint64_t, kSliverDeg.size()> tets_under_deg{};  ///< tets with a dihedral angle under kSliverDeg[i]

  // The worst tets by one measure each, worst first, kWorstTets at most.
  std::vector<WorstTet> smallest_dihedral;
  std::vector<WorstTet> largest_radius_edge;
  std::vector<WorstTet> shortest_edge;  ///< each edge once, with its first tet
  std::vector<WorstTet> least_height;
  std::vector<WorstTet> smallest_scaled_jacobian;
  std::vector<WorstTet> largest_dihedral;
  std::vector<WorstTet> least_volume;
  std::vector<WorstTet> largest_stiffness_ratio;
  std::vector<WorstTet> least_edge_size_ratio;  ///< each edge once, with its first tet; the place is the edge's middle

  /// Fills wave_speed_m_per_s and, from min_height_mm, stable_time_step_us. m_per_s: in m/s. Pre: it is above 0.
  void set_wave_speed(double m_per_s);

  /// The extremes of the distributions above; NaN without tets.
  double min_dihedral_deg() const { return dihedral_deg.min; }
  /// As min_dihedral_deg().
  double max_dihedral_deg() const { return dihedral_deg.max; }
  /// As min_dihedral_deg(); infinite with a flat tet.
  double max_radius_edge() const { return radius_edge.max; }
  /// As max_radius_edge().
  double max_circumradius_mm() const { return circumradius_mm.max; }
  /// The 50th percentile of the tets' signed volumes; NaN without tets.
  double median_volume_mm3() const;
};

/// Measures every tet, edge and boundary facet; of second order, the straight tets between the corners. The stable time
/// steps are those at kWaveSpeedMPerS.
///
/// mesh: tet_regions may be empty (then all tets count as region 1). size: σ, what size_ratio is measured against; null
/// leaves that out. edge_size: what edge_size_ratio is measured against; null leaves that out. Both are asked from
/// several threads. stars: of the mesh, if they are known to a caller within the library; null: they are found.
/// Throws Error (Fault::internal): mesh.inconsistent (a tet or boundary facet names a vertex that is not there,
/// tet_regions has another length than tets, or a coordinate is not finite or beyond 1e60 mm).
/// Guarantees: depends on the arguments only, not on the number of threads; takes about 120 bytes per tet while it
/// runs.
QualitySummary measure_quality(const TetMesh& mesh, const SizingField* size = nullptr,
                               const SizingField* edge_size = nullptr, const TetStars* stars = nullptr);

}  // namespace scantet
