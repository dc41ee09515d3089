// Mesh files: one table of formats, one function to write and one to read. docs/formats.md says what each format holds.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

class FileSet;

enum class MeshContent {
  tets,      ///< the whole mesh, with regions
  boundary,  ///< the boundary triangles only
};

/// What a mesh may carry beside its elements and their regions.
enum class MeshExtra {
  node_sets,     ///< MeshSet::vertices
  facet_sets,    ///< MeshSet::facets
  tet_sets,      ///< MeshSet::tets
  fields,        ///< TetMesh::fields
  materials,     ///< which tets are of which, and their constants; in some formats as fields
  curves,        ///< TetMesh::curves
  region_names,  ///< TetMesh::region_names
  patch_names,   ///< MeshPatch::name
};

/// What can be done with files of one extension.
struct MeshFormat {
  std::string extension;    ///< with its dot, lower case
  std::string description;  ///< a phrase for people
  bool can_read;
  bool can_write;
  MeshContent holds;
  std::vector<MeshExtra> extras;  ///< that its files hold, not counting what stands in comments alone

  /// Whether it is among `extras`.
  bool can_hold(MeshExtra extra) const;
};

/// All formats, in the order in which they are best listed.
const std::vector<MeshFormat>& mesh_formats();
/// That of the path's extension; null if it is none of a mesh.
const MeshFormat* mesh_format_of(const std::string& path);

/// The files and folders that write_mesh() writes for this path: itself, and beside an .xdmf the .h5 that holds its
/// arrays, beside a .vtm the folder .blocks.
std::vector<std::string> mesh_files(const std::string& path);

/// How a mesh is written, where its format leaves a choice.
struct MeshWriteOptions {
  /// Write RAS coordinates (x and y negated) instead of LPS. Half a turn about z: tets stay positively oriented.
  bool ras = false;
  /// Recorded in the file where the format can hold it, on one line (control characters become spaces).
  std::string provenance;
  /// Version written for .msh: "4.1" or "2.2". (.msh2 is always 2.2.)
  std::string gmsh_version = "4.1";
  /// Whether an .inp has *MATERIAL and *SOLID SECTION of the mesh's materials beside their elements.
  bool with_material_constants = true;
  /// The files that this one is to appear with; null: it appears at once.
  FileSet* set = nullptr;
};

/// Writes a mesh in the format that the extension of `path` names (upper or lower case). The file appears whole or not
/// at all (of several, mesh_files(path), the last one is `path`), and so does a folder, where the format is one: what
/// such a folder held before goes, and one that holds anything else is refused. The same mesh and options always give
/// the same bytes. Double coordinates are exact in all formats but .stl, .stls and .ply (single precision), .inp (up to
/// 20 characters: 13 digits at least) and .bdf (16: 12 digits at least, from 1e-9 mm on). The mesh: consistent (see
/// TetMesh), with at least one tet, boundary included. Throws Error: usage.format (unknown extension),
/// usage.gmsh_version, output.* (see AtomicFile), mesh.inconsistent.
void write_mesh(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options = {});

/// What the file says of how it was made: MeshWriteOptions::provenance of a file that write_mesh() wrote; empty if
/// there is none, or none was found near the file's start. Throws Error: usage.format, input.cannot_open, and as
/// read_mesh().
std::string read_provenance(const std::string& path);

/// Reads the tets of a mesh file, of four nodes or of ten (TetMesh::tet_edge_vertices, with strata as of their edges),
/// in the format that the extension of `path` names. Other cells are skipped, and
/// vertices that belong to no tet are left out. Vertices and tets keep their order (in .msh and .inp, that of their
/// numbers), and tets their orientation, also a negative one. Coordinates are LPS: a file that says it is RAS is
/// turned. Regions come from the cell array region, medit:ref, gmsh:physical or CellEntityIds, or from the references,
/// physical groups or element sets of the format. If there is none of these, all are 1; a tet with reference 0 gets the
/// next free number. Names of regions come from .vtu, .msh and .inp, fields from .vtu, .vtk and .msh, sets of vertices
/// and tets from .vtu, .vtk, .msh and .inp, sets of facets from the latter two. The boundary and the junctions are
/// derived from tets and regions (build_boundary). Throws Error: usage.format,
/// input.cannot_open, input.bad_mesh (not of its format, truncated, impossible counts, bad indices, coordinates that
/// are no numbers), input.inp (elements or keywords that are not read), input.no_tets, input.too_large. Guarantees:
/// memory use is bounded by a multiple of the file's size, whatever its header claims.
TetMesh read_mesh(const std::string& path);

/// The same. left_out: gets what the file has and the mesh has not, such as arrays that are no fields, in words
/// ("point array 'temperature'", "*MATERIAL"), each once, other_solids_text() first, then in the file's order; not
/// what follows from the mesh, nor other cells.
TetMesh read_mesh(const std::string& path, std::vector<std::string>& left_out);

/// "2 cells of three dimensions that are no tetrahedra": TetMesh::other_solids in words. count: at least 1.
std::string other_solids_text(std::uint64_t count);

}  // namespace scantet
