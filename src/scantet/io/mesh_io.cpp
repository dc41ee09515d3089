// What all formats have in common: checks before writing, and repairs after reading, which concern form and never
// geometry.
#include "scantet/io/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/regular_file.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {
namespace {

constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();

[[noreturn]] void throw_inconsistent(const std::string& what) {
  throw Error(Fault::internal, "mesh.inconsistent", "the mesh to write is broken: " + what);
}

void require_consistent(const TetMesh& mesh) {
  if (mesh.tets.empty()) throw_inconsistent("it has no tets");
  if (mesh.tet_regions.size() != mesh.tets.size()) throw_inconsistent("not one region a tet");
  if (mesh.facet_regions.size() != mesh.boundary_facets.size()) throw_inconsistent("not one pair of regions a facet");
  if (mesh.strata.size() != mesh.vertices.size()) throw_inconsistent("not one stratum a vertex");
  if (!mesh.tet_edge_vertices.empty() && mesh.tet_edge_vertices.size() != mesh.tets.size()) {
    throw_inconsistent("not six nodes on the edges of each tet");
  }
  const auto exists = [&](VertexId v) { return v < mesh.vertices.size(); };
  for (const Tet& tet : mesh.tets) {
    if (!std::all_of(tet.begin(), tet.end(), exists)) throw_inconsistent("a tet uses a vertex that does not exist");
  }
  for (const auto& nodes : mesh.tet_edge_vertices) {
    if (!std::all_of(nodes.begin(), nodes.end(), exists)) throw_inconsistent("a tet uses a node that does not exist");
  }
  for (const Triangle& facet : mesh.boundary_facets) {
    if (!std::all_of(facet.begin(), facet.end(), exists)) throw_inconsistent("a facet uses a missing vertex");
  }
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Point& p) { return is_finite(p); })) {
    throw_inconsistent("a coordinate is not finite");
  }
}

void require_indices(const RawMesh& raw, const std::string& path) {
  if (raw.vertices.size() >= std::numeric_limits<VertexId>::max()) throw_bad_mesh(path, "it has too many vertices");
  const auto require = [&](const auto& elements) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      for (std::uint64_t v : elements[i]) {
        if (v < raw.vertices.size()) continue;
        throw_bad_mesh(path, "tet " + std::to_string(i) + " (from 0) uses a vertex that does not exist (there are " +
                                 std::to_string(raw.vertices.size()) + ")");
      }
    }
  };
  require(raw.tets);
  require(raw.edge_nodes);
}

/// Tets without a reference get the smallest number above all others.
std::vector<Region> complete_regions(std::vector<Region> references, const std::string& path) {
  const Region largest = std::max(Region{0}, *std::max_element(references.begin(), references.end()));
  const bool all_known = std::find(references.begin(), references.end(), kOutside) == references.end();
  if (all_known) return references;
  if (largest == std::numeric_limits<Region>::max()) throw_bad_mesh(path, "its region numbers are too large");
  std::replace(references.begin(), references.end(), kOutside, static_cast<Region>(largest + 1));
  return references;
}

/// Of letters, digits and _ - . only, which all formats take.
std::string plain(std::string name) {
  const auto is_other = [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-' && c != '.'; };
  std::replace_if(name.begin(), name.end(), is_other, '_');
  return name;
}

/// The sets of a mesh by name, in the order in which they are first asked for.
class SetsByName {
 public:
  MeshSet& of(const std::string& name) {
    const auto [place, is_new] = number_.emplace(plain(name), sets_.size());
    if (is_new) sets_.push_back({place->first, {}, {}, {}});
    return sets_[place->second];
  }
  /// Those with members, each once and ascending.
  std::vector<MeshSet> take() {
    for (MeshSet& set : sets_) {
      for (auto* const members : {&set.vertices, &set.facets, &set.tets}) {
        std::sort(members->begin(), members->end());
        members->erase(std::unique(members->begin(), members->end()), members->end());
      }
    }
    std::erase_if(sets_, [](const MeshSet& s) { return s.vertices.empty() && s.facets.empty() && s.tets.empty(); });
    return std::move(sets_);
  }

 private:
  std::vector<MeshSet> sets_;
  std::map<std::string, std::size_t> number_;
};

/// Sets of facets: of those triangles that are boundary facets, whichever way they go round.
void take_facet_sets(RawMesh& raw, const std::vector<VertexId>& new_id, const TetMesh& mesh, SetsByName& sets) {
  struct Facet {
    Triangle corners;  ///< ascending
    std::uint32_t number;
  };
  const auto is_before = [](const Facet& a, const Facet& b) { return a.corners < b.corners; };
  const auto sorted = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  const auto is_empty = [](const NamedTriangles& set) { return set.corners.empty(); };
  if (std::all_of(raw.facet_sets.begin(), raw.facet_sets.end(), is_empty)) return;
  std::vector<Facet> facets;
  for (std::uint32_t f = 0; f < mesh.boundary_facets.size(); ++f)
    facets.push_back({sorted(mesh.boundary_facets[f]), f});
  std::sort(facets.begin(), facets.end(), is_before);
  for (const NamedTriangles& set : raw.facet_sets) {
    bool are_all_facets = true;
    for (const auto& [a, b, c] : set.corners) {
      const Facet wanted{sorted({new_id[a], new_id[b], new_id[c]}), 0};
      const auto found = std::lower_bound(facets.begin(), facets.end(), wanted, is_before);
      const bool is_facet = found != facets.end() && found->corners == wanted.corners;
      if (is_facet) sets.of(set.name).facets.push_back(found->number);
      are_all_facets = are_all_facets && is_facet;
    }
    if (!are_all_facets) raw.left_out.push_back(named_text("triangles of the set", set.name) + " that are no boundary");
  }
}

/// Fields, and sets of tets, of vertices and of boundary facets, which must be there. new_id: of each vertex of the
/// file.
void take_numbers(RawMesh& raw, const std::vector<VertexId>& new_id, TetMesh& mesh) {
  SetsByName sets;
  const auto set_of = [&](const std::string& array) -> MeshSet& {
    return sets.of(array.substr(std::string_view(kSetPrefix).size()));
  };
  for (const NamedNumbers& array : raw.vertex_numbers) {
    if (array.values.size() != raw.vertices.size()) {
      raw.left_out.push_back(named_text("point array", array.name) + ", which some pieces lack");
      continue;
    }
    MeshSet& set = set_of(array.name);
    for (std::size_t v = 0; v < new_id.size(); ++v) {
      if (array.values[v] != 0 && new_id[v] != kUnused) set.vertices.push_back(new_id[v]);
    }
  }
  for (NamedNumbers& array : raw.tet_numbers) {
    if (array.values.size() != raw.tets.size()) {
      raw.left_out.push_back(named_text("cell array", array.name) + ", which some pieces lack");
      continue;
    }
    if (!array.name.starts_with(kSetPrefix)) {
      mesh.fields.push_back({plain(array.name), std::move(array.values)});
      continue;
    }
    MeshSet& set = set_of(array.name);
    for (std::uint32_t t = 0; t < array.values.size(); ++t) {
      if (array.values[t] != 0) set.tets.push_back(t);
    }
  }
  for (const NamedIndices& set : raw.tet_sets) {
    std::vector<std::uint32_t>& tets = sets.of(set.name).tets;
    for (const std::uint64_t tet : set.members) tets.push_back(static_cast<std::uint32_t>(tet));
  }
  for (const NamedIndices& set : raw.vertex_sets) {
    std::vector<VertexId>& vertices = sets.of(set.name).vertices;
    for (const std::uint64_t v : set.members) {
      if (new_id[v] != kUnused) vertices.push_back(new_id[v]);
    }
  }
  take_facet_sets(raw, new_id, mesh, sets);
  mesh.sets = sets.take();
}

/// Copies the vertices that tets use, in their order, and renumbers the tets. Return: the new number of each vertex.
std::vector<VertexId> take_used_vertices(const RawMesh& raw, const std::string& path, TetMesh& mesh) {
  std::vector<VertexId> new_id(raw.vertices.size(), kUnused);
  for (const auto& tet : raw.tets) {
    for (std::uint64_t v : tet) new_id[v] = 0;
  }
  for (const auto& nodes : raw.edge_nodes) {
    for (std::uint64_t v : nodes) new_id[v] = 0;
  }
  MeshWriteOptions turn;
  turn.ras = raw.ras;
  for (std::size_t v = 0; v < new_id.size(); ++v) {
    if (new_id[v] == kUnused) continue;
    if (!is_finite(raw.vertices[v])) {
      throw_bad_mesh(path, "vertex " + std::to_string(v) + " (from 0) has a coordinate that is not finite");
    }
    new_id[v] = static_cast<VertexId>(mesh.vertices.size());
    mesh.vertices.push_back(in_space(raw.vertices[v], turn));
  }
  mesh.tets.reserve(raw.tets.size());
  for (const auto& tet : raw.tets)
    mesh.tets.push_back({new_id[tet[0]], new_id[tet[1]], new_id[tet[2]], new_id[tet[3]]});
  for (const auto& n : raw.edge_nodes) {
    mesh.tet_edge_vertices.push_back(
        {new_id[n[0]], new_id[n[1]], new_id[n[2]], new_id[n[3]], new_id[n[4]], new_id[n[5]]});
  }
  return new_id;
}

}  // namespace

void require_one_order(const RawMesh& mesh, const std::string& path) {
  if (mesh.edge_nodes.empty() || mesh.edge_nodes.size() == mesh.tets.size()) return;
  throw_bad_mesh(path, std::to_string(mesh.edge_nodes.size()) + " of its " + std::to_string(mesh.tets.size()) +
                           " tetrahedra have ten nodes, the others four");
}

void require_32_bits(const TetMesh& mesh, const std::string& path, const std::string& format) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (mesh.vertices.size() < kMost && mesh.tets.size() + mesh.boundary_facets.size() < kMost) return;
  throw Error(Fault::output, "output.cannot_write", "cannot write '" + path + "': the mesh is too large for " + format,
              "choose another format");
}

std::string header_line(const MeshWriteOptions& options) {
  std::string line = std::string(kSpaceKey) + (options.ras ? "=RAS" : "=LPS");
  if (!options.provenance.empty()) line += "; " + options.provenance;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  return line;
}

void write_mesh(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  const Codec& codec = find_codec(path, &MeshFormat::can_write, "write");
  require_consistent(mesh);
  codec.write(mesh, path, options);
}

std::string other_solids_text(std::uint64_t count) {
  return std::to_string(count) + (count == 1 ? " cell" : " cells") + " of three dimensions that " +
         (count == 1 ? "is no tetrahedron" : "are no tetrahedra");
}

TetMesh read_mesh(const std::string& path) {
  std::vector<std::string> left_out;
  return read_mesh(path, left_out);
}

TetMesh read_mesh(const std::string& path, std::vector<std::string>& left_out) {
  check_regular_file(path);
  RawMesh raw = find_codec(path, &MeshFormat::can_read, "read").read(path);
  if (raw.tets.empty()) {
    throw Error(Fault::input, "input.no_tets",
                "'" + path + "' has no tetrahedra (" + std::to_string(raw.vertices.size()) + " vertices, " +
                    std::to_string(raw.other_cells) + " cells of other types)",
                "give a mesh of tetrahedra of four or ten nodes");
  }
  require_one_order(raw, path);
  require_indices(raw, path);
  TetMesh mesh;
  mesh.other_solids = raw.other_solids;
  mesh.tet_regions = complete_regions(std::move(raw.references), path);
  const std::vector<VertexId> new_id = take_used_vertices(raw, path, mesh);
  for (const Region region : std::set<Region>(mesh.tet_regions.begin(), mesh.tet_regions.end())) {
    const auto name = raw.region_names.find(region);
    if (name != raw.region_names.end()) mesh.region_names.insert(*name);
  }
  build_boundary(mesh);
  take_numbers(raw, new_id, mesh);
  if (raw.other_solids > 0) left_out.push_back(other_solids_text(raw.other_solids));
  std::set<std::string> told;
  for (std::string& each : raw.left_out) {
    if (told.insert(each).second) left_out.push_back(std::move(each));
  }
  return mesh;
}

std::string read_provenance(const std::string& path) {
  constexpr std::size_t kStart = 65536;
  check_regular_file(path);
  std::string text;
  if (file_extension(path) == ".vtu") {
    text = read_vtu(path).provenance;
  } else {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(Fault::input, "input.cannot_open", "cannot open '" + path + "'", "check the path");
    text.resize(kStart);
    file.read(text.data(), static_cast<std::streamsize>(kStart));
    text.resize(static_cast<std::size_t>(file.gcount()));
  }
  for (const char* space : {"=LPS; ", "=RAS; "}) {
    const std::string head = kSpaceKey + std::string(space);
    const std::size_t begin = text.find(head);
    if (begin == std::string::npos) continue;
    text.erase(0, begin + head.size());
    const auto end = std::find_if(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; });
    return {text.begin(), end};
  }
  return {};
}

}  // namespace scantet
