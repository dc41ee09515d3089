// Exodus II, written by the format's own library in the copy that VTK brings, as netCDF's classic format with 64-bit
// offsets: it has no time stamps, and every Exodus program reads it.
#include <vtk_exodusII.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <string>

#include "scantet/base/element_nodes.h"
#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"

namespace scantet {
namespace {

/// A file of the library, closed when it goes out of scope.
class ExodusFile {
 public:
  explicit ExodusFile(const AtomicFile& file) : file_(file) {
    ex_opts(0);  // it prints nothing
    int own_reals = sizeof(double);
    int file_reals = sizeof(double);
    id_ = ex_create(file.part_path().c_str(), EX_CLOBBER | EX_LARGE_MODEL, &own_reals, &file_reals);
    if (id_ < 0) fail();
  }
  ~ExodusFile() {
    if (id_ >= 0) ex_close(id_);
  }
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  int id() const { return id_; }

  /// Takes the status of a call: negative for errors, positive for warnings.
  void check(int status) const {
    if (status < 0) fail();
  }
  void close() {
    const int status = ex_close(id_);
    id_ = -1;
    if (status < 0) fail();
  }

 private:
  /// Throws with the system's reason, or the library's.
  [[noreturn]] void fail() const {
    const char* message = "";
    const char* function = "";
    int code = 0;
    ex_get_err(&message, &function, &code);
    if (const int system_error = file_.append_error(); system_error != 0) {
      throw_output_error(file_.path(), system_error);
    }
    throw Error(Fault::output, "output.cannot_write",
                "cannot write '" + file_.path() + "': Exodus: " + ex_strerror(code), "choose another format");
  }

  const AtomicFile& file_;
  int id_;
};

class ExodusWriter {
 public:
  ExodusWriter(const TetMesh& mesh, const MeshWriteOptions& options, ExodusFile& file)
      : mesh_(mesh),
        options_(options),
        tags_(make_tags(mesh)),
        parts_(make_parts(mesh, tags_)),
        sets_(sets_and_materials(mesh, tags_)),
        curves_(curves_as_sets(mesh, tags_)),
        file_(file) {}

  void write() {
    begin();
    write_provenance();
    write_nodes();
    write_blocks();
    write_side_sets();
    write_node_sets();
    write_named_sets();
    write_fields();
  }

 private:
  void begin() {
    std::size_t longest = 0;
    for (const VolumeTag& volume : tags_.volumes) longest = std::max(longest, node_set_name(volume).size());
    for (const SurfaceTag& surface : tags_.surfaces) longest = std::max(longest, surface.name.size());
    for (const PartTag& part : parts_.parts) longest = std::max(longest, part.name.size());
    for (const auto& [name, set] : sets_) longest = std::max(longest, name.size());
    for (const auto& [name, set] : curves_) longest = std::max(longest, name.size());
    for (const MeshField& field : mesh_.fields) longest = std::max(longest, field.name.size());
    constexpr std::size_t kUsual = 32;  // older programs expect no more
    constexpr std::size_t kMost = 255;  // the library cuts what is longer
    file_.check(ex_set_max_name_length(file_.id(), static_cast<int>(std::clamp(longest, kUsual, kMost))));
    ex_init_params counts{};
    const std::string title = header_line(options_);
    title.copy(counts.title, MAX_LINE_LENGTH);
    counts.num_dim = 3;
    counts.num_nodes = static_cast<std::int64_t>(mesh_.vertices.size());
    counts.num_elem = static_cast<std::int64_t>(mesh_.tets.size());
    counts.num_elem_blk = static_cast<std::int64_t>(parts_.parts.size());
    if (has_materials()) counts.num_elem_sets = static_cast<std::int64_t>(tags_.volumes.size());
    std::int64_t side_sets = 0;
    std::int64_t node_sets = 0;
    for (const auto& [name, set] : sets_) {
      side_sets += set.facets.empty() ? 0 : 1;
      node_sets += set.vertices.empty() ? 0 : 1;
      counts.num_elem_sets += set.tets.empty() ? 0 : 1;
    }
    counts.num_side_sets = static_cast<std::int64_t>(tags_.surfaces.size()) + side_sets;
    counts.num_node_sets =
        static_cast<std::int64_t>(tags_.volumes.size() + (tags_.surfaces.empty() ? 0 : 1) + curves_.size()) + node_sets;
    counts.num_elem_maps = 0;
    file_.check(ex_put_init_ext(file_.id(), &counts));
  }

  /// Blocks are of one material each then, and regions are element sets.
  bool has_materials() const { return !mesh_.materials.empty(); }

  /// Calls take(part, indices of its tets) for each block.
  template <typename Take>
  void for_each_block(const Take& take) const {
    for_each_group(parts_.parts, parts_.part_of_tet, parts_.tets_in, take);
  }

  static std::string node_set_name(const VolumeTag& volume) { return "nodes_" + volume.name; }

  /// The header's line, whole, in records of the length that the format has.
  void write_provenance() {
    const std::string line = header_line(options_);
    std::vector<std::string> records;
    for (std::size_t at = 0; at < line.size(); at += MAX_LINE_LENGTH)
      records.push_back(line.substr(at, MAX_LINE_LENGTH));
    std::vector<char*> pointers;
    pointers.reserve(records.size());
    for (std::string& record : records) pointers.push_back(record.data());
    file_.check(ex_put_info(file_.id(), static_cast<int>(pointers.size()), pointers.data()));
  }

  void write_nodes() {
    std::array<std::vector<double>, 3> columns;
    for (auto& column : columns) column.reserve(mesh_.vertices.size());
    for (const Point& vertex : mesh_.vertices) {
      const Point p = in_space(vertex, options_);
      columns[0].push_back(p.x);
      columns[1].push_back(p.y);
      columns[2].push_back(p.z);
    }
    file_.check(ex_put_coord(file_.id(), columns[0].data(), columns[1].data(), columns[2].data()));
    std::array<std::string, 3> names{"x", "y", "z"};
    std::array<char*, 3> pointers{names[0].data(), names[1].data(), names[2].data()};
    file_.check(ex_put_coord_names(file_.id(), pointers.data()));
  }

  /// Elements stand block by block; the map gives each the number that it has in the mesh, from 1.
  void write_blocks() {
    position_.resize(mesh_.tets.size());
    std::vector<int> numbers;
    numbers.reserve(mesh_.tets.size());
    for_each_block([&](const PartTag& part, std::span<const std::uint32_t> tets) {
      std::vector<int> corners;
      corners.reserve((is_second_order(mesh_) ? 10 : 4) * tets.size());
      for (const std::uint32_t tet : tets) {
        for (const VertexId v : nodes_of_tet(mesh_, tet)) corners.push_back(one_based(v));
        numbers.push_back(one_based(tet));
        position_[tet] = static_cast<int>(numbers.size());
      }
      file_.check(ex_put_block(file_.id(), EX_ELEM_BLOCK, part.tag, is_second_order(mesh_) ? "TETRA10" : "TETRA4",
                               static_cast<std::int64_t>(tets.size()), is_second_order(mesh_) ? 10 : 4, 0, 0, 0));
      file_.check(ex_put_name(file_.id(), EX_ELEM_BLOCK, part.tag, part.name.c_str()));
      file_.check(ex_put_conn(file_.id(), EX_ELEM_BLOCK, part.tag, corners.data(), nullptr, nullptr));
    });
    file_.check(ex_put_id_map(file_.id(), EX_ELEM_MAP, numbers.data()));
  }

  void write_side_sets() {
    for_each_surface(tags_, [&](const SurfaceTag& surface, std::span<const std::uint32_t> facets) {
      put_side_set(surface.tag, surface.name, facets);
    });
  }

  void put_side_set(int tag, const std::string& name, std::span<const std::uint32_t> facets) {
    // Sides go by the vertices they hold: 1 = 1-2-4, 2 = 2-3-4, 3 = 1-3-4, 4 = 1-2-3. Ours go by the vertex they lack.
    constexpr int kSide[4] = {2, 3, 1, 4};
    if (faces_.empty()) faces_ = faces_behind_facets(mesh_);
    std::vector<int> elements;
    std::vector<int> sides;
    for (const std::uint32_t facet : facets) {
      elements.push_back(position_[faces_[facet].tet]);
      sides.push_back(kSide[faces_[facet].face]);
    }
    put_set(EX_SIDE_SET, tag, name, elements, sides.data());
  }

  /// Under numbers above all tags, but for the regions.
  void write_named_sets() {
    if (has_materials()) {
      for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> tets) {
        put_element_set(volume.tag, volume.name, tets);
      });
    }
    int tag = tags_.last_tag + 1;
    for (const auto& [name, set] : sets_) {
      ++tag;
      std::vector<int> nodes;
      for (const VertexId v : set.vertices) nodes.push_back(one_based(v));
      if (!nodes.empty()) put_set(EX_NODE_SET, tag, name, nodes, nullptr);
      if (!set.tets.empty()) put_element_set(tag, name, set.tets);
      if (!set.facets.empty()) put_side_set(tag, name, set.facets);
    }
  }

  void put_element_set(int tag, const std::string& name, std::span<const std::uint32_t> tets) {
    std::vector<int> elements;
    for (const std::uint32_t tet : tets) elements.push_back(position_[tet]);
    std::sort(elements.begin(), elements.end());
    put_set(EX_ELEM_SET, tag, name, elements, nullptr);
  }

  void write_node_sets() {
    for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> tets) {
      put_set(EX_NODE_SET, volume.tag, node_set_name(volume), members(vertices_of_tets(mesh_, tets)), nullptr);
    });
    write_curves();
    if (tags_.surfaces.empty()) return;
    put_set(EX_NODE_SET, tags_.last_tag + 1, "boundary", members(vertices_of_boundary(mesh_)), nullptr);
  }

  /// Defined in one go: the library writes the file anew for each definition, and curves of label maps are many.
  void write_curves() {
    std::vector<std::vector<int>> nodes;
    std::vector<ex_set> sets;
    nodes.reserve(curves_.size());
    int tag = tags_.surfaces.empty() ? 0 : tags_.surfaces.back().tag;
    for (const auto& [name, set] : curves_) {
      std::vector<int>& of_curve = nodes.emplace_back();
      for (const VertexId v : set.vertices) of_curve.push_back(one_based(v));
      ex_set& entry = sets.emplace_back();
      entry.id = ++tag;
      entry.type = EX_NODE_SET;
      entry.num_entry = static_cast<std::int64_t>(of_curve.size());
      entry.entry_list = of_curve.data();
    }
    if (sets.empty()) return;
    file_.check(ex_put_sets(file_.id(), sets.size(), sets.data()));
    for (std::size_t i = 0; i < sets.size(); ++i) {
      file_.check(ex_put_name(file_.id(), EX_NODE_SET, sets[i].id, curves_[i].name.c_str()));
    }
  }

  /// Element variables at the only time step, 0.
  void write_fields() {
    if (mesh_.fields.empty()) return;
    file_.check(ex_put_variable_param(file_.id(), EX_ELEM_BLOCK, static_cast<int>(mesh_.fields.size())));
    const double time = 0;
    file_.check(ex_put_time(file_.id(), 1, &time));
    for (std::size_t f = 0; f < mesh_.fields.size(); ++f) {
      const MeshField& field = mesh_.fields[f];
      const int number = one_based(static_cast<std::uint32_t>(f));
      file_.check(ex_put_variable_name(file_.id(), EX_ELEM_BLOCK, number, field.name.c_str()));
    }
    for (std::size_t f = 0; f < mesh_.fields.size(); ++f) {
      for_each_block([&](const PartTag& part, std::span<const std::uint32_t> tets) {
        std::vector<double> values;
        values.reserve(tets.size());
        for (const std::uint32_t tet : tets) values.push_back(mesh_.fields[f].values[tet]);
        file_.check(ex_put_var(file_.id(), 1, EX_ELEM_BLOCK, one_based(static_cast<std::uint32_t>(f)), part.tag,
                               static_cast<std::int64_t>(values.size()), values.data()));
      });
    }
  }

  void put_set(ex_entity_type type, int tag, const std::string& name, const std::vector<int>& entries,
               const int* sides) const {
    file_.check(ex_put_set_param(file_.id(), type, tag, static_cast<std::int64_t>(entries.size()), 0));
    file_.check(ex_put_set(file_.id(), type, tag, entries.data(), sides));
    file_.check(ex_put_name(file_.id(), type, tag, name.c_str()));
  }

  static int one_based(std::uint32_t index) { return static_cast<int>(index) + 1; }

  static std::vector<int> members(const std::vector<std::uint8_t>& is_member) {
    std::vector<int> numbers;
    for (std::size_t v = 0; v < is_member.size(); ++v) {
      if (is_member[v] != 0) numbers.push_back(one_based(static_cast<std::uint32_t>(v)));
    }
    return numbers;
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  MeshParts parts_;
  std::vector<NamedSet> sets_;
  std::vector<NamedSet> curves_;  ///< their nodes
  ExodusFile& file_;
  std::vector<TetFace> faces_;  ///< behind each facet, once they are needed
  std::vector<int> position_;   ///< of each tet among the elements, from 1
};

}  // namespace

void write_exodus(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  require_32_bits(mesh, path, "Exodus");
  AtomicFile part(path, ".part", options.set);
  ExodusFile file(part);
  ExodusWriter(mesh, options, file).write();
  file.close();
  part.commit();
}

}  // namespace scantet
