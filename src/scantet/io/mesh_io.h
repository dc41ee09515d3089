// Mesh files: one table of formats, one function to write and one to read. docs/formats.md says what each format holds.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

class FileSet;

/// What of a mesh the files of a format hold.
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
  std::string extension;          ///< with its dot, lower case
  std::string description;        ///< a phrase for people
  bool can_read;                  ///< by read_mesh()
  bool can_write;                 ///< by write_mesh()
  MeshContent holds;              ///< what is written
  std::vector<MeshExtra> extras;  ///< that its files hold, not counting what stands in comments alone

  /// Whether it is among `extras`.
  bool can_hold(MeshExtra extra) const;
};

/// All formats, in the order in which they are best listed; the same list at each call.
const std::vector<MeshFormat>& mesh_formats();
/// That of the path's extension (upper or lower case), in mesh_formats(); null if it is none of a mesh.
const MeshFormat* mesh_format_of(const std::string& path);

/// The files and folders that write_mesh() writes for this path: first itself, and then beside an .xdmf the .h5 that
/// holds its arrays, beside a .vtm the folder .blocks.
std::vector<std::string> mesh_files(const std::string& path);

/// How a mesh is written, where its format leaves a choice.
struct MeshWriteOptions {
  /// Write RAS coordinates (x and y negated) instead of LPS. Half a turn about z: tets stay positively oriented.
  bool ras = false;
  /// How the mesh was made; may be empty. Recorded in the file where the format can hold it, on one line (control
  /// characters become spaces).
  std::string provenance;
  /// Version written for .msh: "4.1" or "2.2"; not looked at for other formats. (.msh2 is always 2.2.)
  std::string gmsh_version = "4.1";
  /// Whether an .inp, .feb, .bdf or .elmer has the constants of the mesh's materials, as far as they are known, beside
  /// their elements (of an .inp *MATERIAL and *SOLID SECTION).
  bool with_material_constants = true;
  /// The files that this one is to appear with, for scantet's own programs; null: it appears before write_mesh()
  /// returns.
  FileSet* set = nullptr;
};

/// Writes a mesh in the format that the extension of `path` names (upper or lower case). The file appears whole or not
/// at all (of several, mesh_files(path), `path` appears last), and so does a folder, where the format is one: what
/// such a folder held before goes, and one that holds anything else is refused. The same mesh and options always give
/// the same bytes. Double coordinates are exact in all formats but .stl, .stls and .ply (single precision), .inp (up to
/// 20 characters: 13 digits at least) and .bdf (16: 12 digits at least, from 1e-9 mm on).
/// Pre: the mesh is consistent (see TetMesh), with at least one tet, boundary included.
/// Throws Error: usage.format (an extension that is not written), usage.gmsh_version; output.cannot_write (also a mesh
/// that the format cannot hold), output.full, output.partial (the first of several files appeared, and the next
/// cannot); of Fault::internal mesh.inconsistent (no tets, arrays of unequal lengths, a vertex that is not there, a
/// coordinate that is not finite, an edge of a curve that is none of a tet), mesh.facet (a facet that is no face of a
/// tet of its region; not of all formats).
void write_mesh(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options = {});

/// What the file says of how it was made: MeshWriteOptions::provenance of a file that write_mesh() wrote, as its format
/// holds it, on one line; empty if there is none, or if none was found in the file's first 64 KiB. path: any file.
/// Throws Error: input.cannot_open (it is not there or may not be read), input.not_a_file (a pipe, a device or a
/// socket); of a .vtu, which is read as a whole, also input.bad_mesh and input.no_tets (it is no UnstructuredGrid).
std::string read_provenance(const std::string& path);

/// Reads the tets of a mesh file, of four nodes or of ten (TetMesh::tet_edge_vertices, with strata as of their edges),
/// in the format that the extension of `path` names (upper or lower case). Other cells are skipped, but for solids in
/// an .inp, which are refused; TetMesh::other_solids counts those of three dimensions. Vertices that belong to no tet
/// are left out. Vertices and tets keep their order (in .msh and .inp, that of their numbers), and tets their
/// orientation, also a negative one. Coordinates are LPS: a file that says it is RAS is turned. Regions come from the
/// cell array region, medit:ref, gmsh:physical or CellEntityIds, or from the references, physical groups or element
/// sets of the format. If there is none of these, all are 1; a tet with reference 0 gets the number after the largest.
/// Names of regions come from .vtu, .msh and .inp, fields from .vtu, .vtk and .msh, sets of vertices and tets from
/// .vtu, .vtk, .msh and .inp, sets of facets from the latter two; characters of the names of fields and sets other than
/// letters, digits, _, - and . become _. The boundary and the junctions are derived from tets and regions. Throws
/// Error: usage.format (an extension that is not read), input.not_a_file (a pipe, a device or a socket),
/// input.cannot_open, input.bad_mesh (not of its format, empty, truncated, impossible counts, bad indices, coordinates
/// that are no numbers, tets of both orders), input.inp (elements or keywords that are not read), input.no_tets,
/// input.too_large (2^30 tets or more). Guarantees: memory use is bounded by a multiple of the file's size, whatever
/// its header claims.
TetMesh read_mesh(const std::string& path);

/// The same. left_out: what the file has and the mesh has not, such as arrays that are no fields, is added to it in
/// words ("point array 'temperature'", "*MATERIAL"), each once, other_solids_text() first, then as it was found; not
/// what follows from the mesh, nor other cells of fewer dimensions.
TetMesh read_mesh(const std::string& path, std::vector<std::string>& left_out);

/// "2 cells of three dimensions that are no tetrahedra": TetMesh::other_solids in words. count: at least 1.
std::string other_solids_text(std::uint64_t count);

}  // namespace scantet
