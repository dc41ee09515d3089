// A mesh as the page's view takes it: flat arrays of small numbers.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "scantet/quality/quality.h"

namespace scantet {

/// A measure that tets can be coloured by, one byte a tet: 0 is `low` or less, 255 `high` or more.
struct PageColoring {
  std::string key;    ///< stable: "min_dihedral_deg"
  std::string title;  ///< "smallest dihedral angle"
  std::string unit;
  double low;
  double high;
  bool low_is_bad;
  std::vector<std::uint8_t> values;
};

struct PageMesh {
  static constexpr std::uint32_t kNoTet = 0xffffffff;
  static constexpr std::uint16_t kNoRegion = 0xffff;

  Point center;                             ///< of the bounding box, mm
  double scale_mm = 1;                      ///< half of its diagonal
  std::vector<float> coordinates;           ///< x, y, z of each vertex: (p − center) / scale_mm
  std::vector<std::uint32_t> tets;          ///< four vertices each
  std::vector<std::uint32_t> facets;        ///< three vertices each, of every boundary facet
  std::vector<std::uint32_t> facet_tets;    ///< the tet behind each facet; kNoTet if left out
  std::vector<std::uint32_t> facet_fronts;  ///< the tet in front; kNoTet if it is outside or left out
  std::vector<std::uint16_t> facet_sides;   ///< two a facet, behind and in front: of `regions`; kNoRegion: outside
  std::vector<std::uint16_t> tet_regions;   ///< of each tet the place among `regions`
  std::vector<PageColoring> colorings;
  std::vector<PageColoring> facet_colorings;  ///< likewise, one byte a facet
  std::vector<Region> regions;                ///< ascending; empty, as the three arrays above, if there is one only
  std::vector<std::uint32_t> numbers;         ///< of the tets, in the mesh; empty if all of them are here
};

/// All of the mesh if it has at most `most_tets` tets, else its boundary and the worst tets that `quality` names.
/// Pre: `quality` is that of the mesh (so coordinates are finite, vertex ids valid).
PageMesh make_page_mesh(const TetMesh& mesh, const QualitySummary& quality, std::size_t most_tets);

/// Adds a coloring of facets by how far each is from something, its title: "distance from …"; most_mm: where the scale
/// ends, > 0.
void color_by_distance(const std::vector<double>& facets_off_mm, double most_mm, const std::string& title,
                       PageMesh& page);

/// Bytes as text.
std::string base64(const std::vector<std::uint8_t>& bytes);

/// The arrays in the order of their declaration, values of colorings last, little-endian, as base64.
void write_arrays(std::ostream& out, const PageMesh& mesh);

}  // namespace scantet
