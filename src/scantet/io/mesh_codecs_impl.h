// One writer and reader a format; mesh_io.cpp chooses among them. Private to io/.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/unfinished_file_impl.h"

namespace scantet {

/// An array of a file with its name.
struct NamedNumbers {
  std::string name;
  std::vector<double> values;
};

/// Tets or vertices that a file puts together under a name, by index.
struct NamedIndices {
  std::string name;
  std::vector<std::uint64_t> members;
};

/// Triangles that a file puts together under a name, by the indices of their corners.
struct NamedTriangles {
  std::string name;
  std::vector<std::array<std::uint64_t, 3>> corners;
};

/// What a reader found in a file, before regions are filled in and unused vertices dropped.
struct RawMesh {
  std::vector<Point> vertices;
  std::vector<std::array<std::uint64_t, 4>> tets;  ///< vertex indices from 0, not checked yet
  std::vector<Region> references;                  ///< one a tet, 0 where the file has none
  /// Of tets of ten nodes: those on edges, as TetMesh::tet_edge_vertices. Empty, or one a tet, else the file mixes
  /// them.
  std::vector<std::array<std::uint64_t, 6>> edge_nodes;
  std::map<Region, std::string> region_names;  ///< may name regions that no tet has
  /// One value a tet or a vertex, else the array is left out. Those called set_NAME are not 0 in the set.
  std::vector<NamedNumbers> tet_numbers;
  std::vector<NamedNumbers> vertex_numbers;
  /// Sets; names may repeat, then they are one. Those of triangles count where these are boundary facets.
  std::vector<NamedIndices> tet_sets;
  std::vector<NamedIndices> vertex_sets;
  std::vector<NamedTriangles> facet_sets;
  std::vector<std::string> left_out;  ///< what the file has beside that and was not taken, in words; may repeat
  std::uint64_t other_cells = 0;      ///< cells of other types that were skipped
  std::uint64_t other_solids = 0;     ///< those of them that have three dimensions, or that are not known
  bool ras = false;                   ///< the file says that its space is RAS
  std::string provenance;             ///< its header_line(), if the reader keeps it
};

/// A format with its writer and its reader, null where there is none.
struct Codec {
  MeshFormat format;
  void (*write)(const TetMesh&, const std::string&, const MeshWriteOptions&);
  RawMesh (*read)(const std::string&);
  FolderContent content = nullptr;  ///< what is written is a folder
};

/// The format of the path's extension. able: what it must be able to; verb: the same for people. Throws Error
/// (usage.format).
const Codec& find_codec(const std::string& path, bool MeshFormat::*able, const char* verb);

/// Throws Error (input.bad_mesh) if some tets have ten nodes and others have four.
void require_one_order(const RawMesh& mesh, const std::string& path);

/// How a file says what its space is. 3D Slicer understands this in headers, comments and field data.
inline constexpr const char* kSpaceKey = "SPACE";

/// The field array of a .vtu with its header_line, one character a value.
inline constexpr const char* kProvenance = "provenance";

/// The field array of a .vtu with the names of regions, one character a value: of each a line, its number and its name.
inline constexpr const char* kRegionNames = "region_names";

/// What the arrays of sets have before their names.
inline constexpr const char* kSetPrefix = "set_";

/// "SPACE=LPS" or "SPACE=RAS", then the provenance.
std::string header_line(const MeshWriteOptions& options);

/// Throws if the mesh has more vertices or elements than signed numbers of 32 bits count, which the format has.
void require_32_bits(const TetMesh& mesh, const std::string& path, const std::string& format);

/// The point in the space the options ask for. Subtraction, so that zero stays +0.
inline Point in_space(const Point& p, const MeshWriteOptions& options) {
  return options.ras ? Point{0 - p.x, 0 - p.y, p.z} : p;
}

void write_vtu(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_vtk(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_stl(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_ply(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_medit(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
/// Gmsh in the version of the options.
void write_msh(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
/// Gmsh 2.2 whatever the options say.
void write_msh2(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_inp(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_feb(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_bdf(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_exodus(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_med(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_xdmf(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);

void write_elmer(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_mesh_complete(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
void write_vtm(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);
/// A folder with an STL of each patch.
void write_stls(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options);

/// FolderContent of the formats that are folders, and of the blocks of a .vtm.
bool is_elmer_file(std::string_view name);
bool is_mesh_complete_file(std::string_view name);
bool is_block_file(std::string_view name);
bool is_stl_file(std::string_view name);

/// What a folder that write_mesh() writes at this path may hold; null: it writes a file.
FolderContent folder_content(const std::string& path);

/// The folder of blocks that write_vtm() writes beside `path`.
std::string vtm_blocks_path(const std::string& path);
/// The file of arrays that write_xdmf() writes beside `path`.
std::string xdmf_arrays_path(const std::string& path);

RawMesh read_vtu(const std::string& path);
RawMesh read_vtk(const std::string& path);
RawMesh read_medit(const std::string& path);
RawMesh read_msh(const std::string& path);
RawMesh read_inp(const std::string& path);

}  // namespace scantet
