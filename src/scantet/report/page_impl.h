// The page that people explore a mesh in: one file that needs nothing else, and no network.
#pragma once

#include <iosfwd>
#include <span>

#include "scantet/report/difference.h"
#include "scantet/report/report.h"

namespace scantet {

/// A mesh with more tets is shown by its boundary and its worst tets alone, and the page says so: browsers hold about
/// 40 bytes a tet twice while they read the page.
inline constexpr std::size_t kMostTetsInPage = 4'000'000;

/// meshes: as many as reports; of those that lack `quality` or `mesh`, these are found first. Text from outside (names,
/// options, findings) reaches the page as data, never as markup. difference: of the two meshes, whose surfaces can then
/// be coloured by distance; or null. Throws Error: mesh.inconsistent (as measure_quality()), mesh.facet (as
/// faces_behind_facets()).
void write_page(std::ostream& out, std::span<const Report> reports, std::span<const TetMesh> meshes,
                std::size_t most_tets = kMostTetsInPage, const ReportDifference* difference = nullptr);

}  // namespace scantet
