// Abaqus input, as CalculiX and Abaqus read it. A number there is at most 20 characters long (CalculiX reads the first
// 20 and silently drops the rest, exponent included), so a coordinate that needs more loses its last digits.
#include <algorithm>
#include <string>

#include "scantet/base/ascii_text.h"
#include "scantet/base/element_nodes.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/file_names.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/taken_names_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

constexpr const char* kAllElements = "EALL";
constexpr const char* kAllNodes = "NALL";
constexpr const char* kBoundaryNodes = "BOUNDARY";
constexpr const char* kNodesOf = "NODES_";  ///< before a region's name
/// Before a set's name, as CalculiX 2.20 crashes on a load of a surface that is called as a set of elements is.
constexpr const char* kElementsOf = "ELEMENTS_";

/// A set's name: letters, digits and underscores only. -3 becomes M3.
std::string name_part(Region region) {
  std::string text = std::to_string(region);
  if (text[0] == '-') text[0] = 'M';
  return text;
}

/// A name of the mesh's own as a set's.
std::string plain_name(const std::string& name) {
  std::string plain = ascii_upper(name);
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == '-' || c == '.'; }, '_');
  return plain;
}

/// All names of a mesh as sets', made distinct: those that differ by "-", "." and "_" alone become one here.
struct AllNames {
  std::vector<std::string> volumes;
  std::vector<std::string> surfaces;
  std::vector<std::string> curves;  ///< and corners
  InpNames of_users;

  explicit AllNames(const MeshTags& tags) {
    for (const VolumeTag& volume : tags.volumes) {
      volumes.push_back(taken_.distinct(set_name(volume), kNodesOf));
      of_users.regions[volume.region] = volumes.back();
    }
    for (const SurfaceTag& surface : tags.surfaces) surfaces.push_back(taken_.distinct(set_name(surface)));
    for (const std::string& name : tags.set_names) {
      of_users.sets.push_back(taken_.distinct(plain_name(name), kElementsOf));
    }
    for (const std::string& name : tags.material_names) {
      of_users.materials.push_back(taken_.distinct("MATERIAL_" + plain_name(name)));
    }
    for (const CurveTag& curve : tags.curves) curves.push_back(taken_.distinct(set_name(curve)));
    if (tags.corners) curves.push_back(taken_.distinct(plain_name(tags.corners->name)));
  }

 private:
  static std::string set_name(const VolumeTag& volume) {
    return volume.is_named ? plain_name(volume.name) : "REGION_" + name_part(volume.region);
  }
  static std::string set_name(const SurfaceTag& surface) {
    if (surface.is_named) return plain_name(surface.name);
    return "BOUNDARY_" + name_part(surface.regions[0]) + "_" + name_part(surface.regions[1]);
  }
  static std::string set_name(const CurveTag& curve) {
    if (curve.is_named) return plain_name(curve.name);
    std::string name = "CURVE";
    for (const Region region : curve.regions) name += "_" + name_part(region);
    return name;
  }

  TakenNames taken_{kAllElements, kAllNodes, kBoundaryNodes};
};

/// The shortest exact number if it fits in 20 characters, else the most digits that do.
class Number20 {
 public:
  explicit Number20(double value) {
    auto end = std::to_chars(text_, text_ + sizeof text_, value).ptr;
    for (int digits = 17; end - text_ > 20; --digits) {
      end = std::to_chars(text_, text_ + sizeof text_, value, std::chars_format::general, digits).ptr;
    }
    size_ = static_cast<std::size_t>(end - text_);
  }
  operator std::string_view() const { return {text_, size_}; }

 private:
  char text_[64];
  std::size_t size_;
};

class InpWriter {
 public:
  InpWriter(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& out)
      : mesh_(mesh), options_(options), tags_(make_tags(mesh)), names_(tags_), out_(out) {}

  void write() {
    out_ << "** " << header_line(options_) << '\n';
    write_nodes();
    for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> tets) {
      write_region(names_.volumes[static_cast<std::size_t>(&volume - tags_.volumes.data())], tets);
    });
    write_all_elements_set();
    write_boundary_nodes();
    write_curve_nodes();
    write_surfaces();
    for (std::size_t s = 0; s < mesh_.sets.size(); ++s) write_set(names_.of_users.sets[s], mesh_.sets[s]);
    write_materials();
  }

 private:
  void write_nodes() {
    out_ << "*NODE, NSET=" << kAllNodes << '\n';
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const Point p = in_space(mesh_.vertices[v], options_);
      out_ << v + 1 << ", " << Number20(p.x) << ", " << Number20(p.y) << ", " << Number20(p.z) << '\n';
    }
  }

  void write_region(const std::string& name, std::span<const std::uint32_t> tets) {
    out_ << (is_second_order(mesh_) ? "*ELEMENT, TYPE=C3D10, ELSET=" : "*ELEMENT, TYPE=C3D4, ELSET=") << name << '\n';
    for (const std::uint32_t tet : tets) {
      out_ << std::uint64_t{tet} + 1;
      for (VertexId v : nodes_of_tet(mesh_, tet)) out_ << ", " << std::uint64_t{v} + 1;
      out_ << '\n';
    }
    write_node_set(kNodesOf + name, vertices_of_tets(mesh_, tets));
  }

  void write_node_set(const std::string& name, const std::vector<std::uint8_t>& member) {
    std::vector<std::uint32_t> vertices;
    for (std::size_t v = 0; v < member.size(); ++v) {
      if (member[v] != 0) vertices.push_back(static_cast<std::uint32_t>(v));
    }
    out_ << "*NSET, NSET=" << name << '\n';
    write_list(vertices);
  }

  /// Numbers from 1 on, as lines.
  void write_list(const std::vector<std::uint32_t>& members) {
    constexpr std::size_t kPerLine = 16;  // the most that the format allows
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0) out_ << (i % kPerLine == 0 ? "\n" : ", ");
      out_ << std::uint64_t{members[i]} + 1;
    }
    out_ << '\n';
  }

  void write_set(const std::string& name, const MeshSet& set) {
    if (!set.vertices.empty()) {
      out_ << "*NSET, NSET=" << name << '\n';
      write_list(set.vertices);
    }
    if (!set.tets.empty()) {
      out_ << "*ELSET, ELSET=" << kElementsOf << name << '\n';
      write_list(set.tets);
    }
    if (!set.facets.empty()) write_surface(name, set.facets);
  }

  void write_all_elements_set() {
    out_ << "*ELSET, ELSET=" << kAllElements << '\n';
    for (const std::string& name : names_.volumes) out_ << name << '\n';
  }

  void write_boundary_nodes() {
    if (!mesh_.boundary_facets.empty()) write_node_set(kBoundaryNodes, vertices_of_boundary(mesh_));
  }

  /// Of nodes alone: elements along a curve would be beams or trusses, with a stiffness of their own.
  void write_curve_nodes() {
    const std::vector<NamedSet> curves = curves_as_sets(mesh_, tags_);
    for (std::size_t i = 0; i < curves.size(); ++i) write_set(names_.curves[i], curves[i].set);
  }

  /// The elements of each material, and its constants if they are known, in MPa and tonne/mm³.
  void write_materials() {
    std::vector<std::vector<std::uint32_t>> tets(mesh_.materials.size());
    for (std::uint32_t t = 0; t < mesh_.tet_materials.size(); ++t) tets[mesh_.tet_materials[t]].push_back(t);
    for (std::size_t m = 0; m < tets.size(); ++m) {
      const MeshMaterial& material = mesh_.materials[m];
      const std::string& name = names_.of_users.materials[m];
      out_ << "*ELSET, ELSET=" << name << '\n';
      write_list(tets[m]);
      if (!options_.with_material_constants || !(material.youngs_modulus_mpa > 0)) continue;
      out_ << "*MATERIAL, NAME=" << name << "\n*ELASTIC\n"
           << Number20(material.youngs_modulus_mpa) << ", " << Number20(material.poissons_ratio) << '\n';
      if (material.density_tonne_per_mm3 > 0) {
        out_ << "*DENSITY\n" << Number20(material.density_tonne_per_mm3) << '\n';
      }
      out_ << "*SOLID SECTION, ELSET=" << name << ", MATERIAL=" << name << '\n';
    }
  }

  void write_surfaces() {
    for_each_surface(tags_, [&](const SurfaceTag& surface, std::span<const std::uint32_t> facets) {
      write_surface(names_.surfaces[static_cast<std::size_t>(&surface - tags_.surfaces.data())], facets);
    });
  }

  void write_surface(const std::string& name, std::span<const std::uint32_t> facets) {
    // Abaqus counts faces by the vertices they hold: S1 = 1-2-3, S2 = 1-4-2, S3 = 2-4-3, S4 = 3-4-1. Ours go by the
    // vertex they lack: 0 is S3, 1 is S4, 2 is S2, 3 is S1.
    constexpr char kFaceNumber[4] = {'3', '4', '2', '1'};
    if (faces_.empty()) faces_ = faces_behind_facets(mesh_);
    out_ << "*SURFACE, NAME=" << name << ", TYPE=ELEMENT\n";
    for (const std::uint32_t facet : facets) {
      const TetFace& face = faces_[facet];
      out_ << std::uint64_t{face.tet} + 1 << ", S" << kFaceNumber[face.face] << '\n';
    }
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  AllNames names_;
  TextWriter out_;
  std::vector<TetFace> faces_;  ///< behind each facet, once they are needed
};

}  // namespace

InpNames inp_names(const TetMesh& mesh) {
  return AllNames(make_tags(mesh)).of_users;
}

void write_inp(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  write_file(
      path, [&](std::ostream& out) { InpWriter(mesh, options, out).write(); }, options.set);
}

}  // namespace scantet
