// The table of formats: who writes and reads each, and what its files can hold.
#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/io/mesh_codecs_impl.h"

namespace scantet {
namespace {

using enum MeshExtra;
using Extras = std::vector<MeshExtra>;

Extras all_but(const Extras& left_out) {
  Extras extras;
  for (const MeshExtra extra :
       {node_sets, facet_sets, tet_sets, fields, materials, curves, region_names, patch_names}) {
    if (std::find(left_out.begin(), left_out.end(), extra) == left_out.end()) extras.push_back(extra);
  }
  return extras;
}

/// Extras as docs/formats.md has them. A name in a comment alone is not held, for no program reads it.
const std::vector<Codec>& codecs() {
  using enum MeshContent;
  static const std::vector<Codec> table = {
      {{".vtu", "VTK XML unstructured grid, binary, compressed", true, true, tets,
        all_but({facet_sets, curves, patch_names})},
       write_vtu,
       read_vtu},
      {{".vtk", "VTK legacy unstructured grid, binary", true, true, tets,
        all_but({facet_sets, curves, region_names, patch_names})},
       write_vtk,
       read_vtk},
      {{".msh", "Gmsh 4.1 (or 2.2), ASCII", true, true, tets, all_but({})}, write_msh, read_msh},
      {{".msh2", "Gmsh 2.2, ASCII", true, true, tets, all_but({})}, write_msh2, read_msh},
      {{".mesh", "MEDIT, ASCII", true, true, tets, {curves}}, write_medit, read_medit},
      {{".inp", "Abaqus and CalculiX input", true, true, tets, all_but({fields})}, write_inp, read_inp},
      {{".feb", "FEBio 4.0", false, true, tets, all_but({})}, write_feb, nullptr},
      {{".bdf", "Nastran bulk data", false, true, tets, all_but({fields, region_names, patch_names})},
       write_bdf,
       nullptr},
      {{".e", "Exodus II", false, true, tets, all_but({})}, write_exodus, nullptr},
      {{".exo", "Exodus II", false, true, tets, all_but({})}, write_exodus, nullptr},
      {{".med", "MED 4.1, for SALOME and code_aster", false, true, tets, all_but({})}, write_med, nullptr},
      {{".xdmf", "XDMF, with an .h5 of its name beside it", false, true, tets, all_but({})}, write_xdmf, nullptr},
      {{".vtm", "VTK multi-block, with a folder .blocks of its name beside it", false, true, tets, all_but({})},
       write_vtm,
       nullptr},
      {{".elmer", "Elmer, a folder", false, true, tets, {materials, region_names, patch_names}},
       write_elmer,
       nullptr,
       is_elmer_file},
      {{".mesh-complete", "SimVascular, a folder", false, true, tets, all_but({curves, region_names})},
       write_mesh_complete,
       nullptr,
       is_mesh_complete_file},
      {{".stls", "a folder with an STL of each patch", false, true, boundary, {facet_sets, patch_names}},
       write_stls,
       nullptr,
       is_stl_file},
      {{".stl", "boundary triangles, binary STL", false, true, boundary, {}}, write_stl, nullptr},
      {{".ply", "boundary triangles, binary PLY", false, true, boundary, {}}, write_ply, nullptr},
  };
  return table;
}

}  // namespace

bool MeshFormat::can_hold(MeshExtra extra) const {
  return std::find(extras.begin(), extras.end(), extra) != extras.end();
}

const Codec& find_codec(const std::string& path, bool MeshFormat::*able, const char* verb) {
  const std::string extension = file_extension(path);
  std::string known;
  for (const Codec& codec : codecs()) {
    if (!(codec.format.*able)) continue;
    if (codec.format.extension == extension) return codec;
    known += (known.empty() ? "" : " ") + codec.format.extension;
  }
  const std::string place = extension.empty() ? "it has no extension" : "its extension is '" + extension + "'";
  throw Error(Fault::usage, "usage.format", std::string("cannot ") + verb + " '" + path + "' as a mesh: " + place,
              "use one of " + known);
}

const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> formats = [] {
    std::vector<MeshFormat> list;
    for (const Codec& codec : codecs()) list.push_back(codec.format);
    return list;
  }();
  return formats;
}

const MeshFormat* mesh_format_of(const std::string& path) {
  const std::vector<MeshFormat>& formats = mesh_formats();
  const auto found =
      std::find_if(formats.begin(), formats.end(),
                   [extension = file_extension(path)](const auto& format) { return format.extension == extension; });
  return found == formats.end() ? nullptr : &*found;
}

std::vector<std::string> mesh_files(const std::string& path) {
  if (file_extension(path) == ".xdmf") return {path, xdmf_arrays_path(path)};
  if (file_extension(path) == ".vtm") return {path, vtm_blocks_path(path)};
  return {path};
}

FolderContent folder_content(const std::string& path) {
  const std::string extension = file_extension(path);
  if (extension == file_extension(vtm_blocks_path("a.vtm"))) return is_block_file;
  for (const Codec& codec : codecs()) {
    if (codec.format.extension == extension) return codec.content;
  }
  return nullptr;
}

}  // namespace scantet
