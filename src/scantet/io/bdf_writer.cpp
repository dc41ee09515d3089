// Nastran bulk data in fixed fields. A real number has 16 columns at most, in Nastran's own short notation (1.5-7), so
// a coordinate that needs more loses its last digits. Groups have no names there, only properties' numbers: comments
// say which is which.
#include <algorithm>
#include <charconv>
#include <string>

#include "scantet/base/element_nodes.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kSmall = 8;   // columns of a field
constexpr std::size_t kLarge = 16;  // of a field of a card whose name ends with *
constexpr std::uint64_t kMostInSmall = 99'999'999;

/// The significant digits of a number, without a point or zeros at the end, and the power of ten of the first.
struct Decimal {
  bool is_negative = false;
  std::string digits;
  int power = 0;
};

/// The number rounded to so many digits; 0: the fewest that give the same double back. Not for zero.
Decimal decimal_of(double value, int digits) {
  char text[64];
  const char* const end =
      digits == 0 ? std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr
                  : std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
  const char* const e = std::find(static_cast<const char*>(text), end, 'e');
  Decimal decimal;
  decimal.is_negative = text[0] == '-';
  std::copy_if(static_cast<const char*>(text), e, std::back_inserter(decimal.digits),
               [](char c) { return c >= '0' && c <= '9'; });
  decimal.digits.erase(decimal.digits.find_last_not_of('0') + 1);
  std::from_chars(e[1] == '+' ? e + 2 : e + 1, end, decimal.power);
  return decimal;
}

/// The shorter of 123.4 and 1.234+2, of .0123 and 1.23-2.
std::string nastran_form(const Decimal& decimal) {
  const auto count = static_cast<int>(decimal.digits.size());
  std::string scientific = decimal.digits;
  scientific.insert(1, ".");
  scientific += (decimal.power < 0 ? "" : "+") + std::to_string(decimal.power);
  std::string fixed = decimal.digits;
  constexpr int kMostZeros = 20;  // more make it longer than the other form
  if (decimal.power < 0 && decimal.power > -kMostZeros) {
    fixed = "." + std::string(static_cast<std::size_t>(-decimal.power - 1), '0') + fixed;
  } else if (decimal.power >= 0 && decimal.power < kMostZeros) {
    fixed.append(static_cast<std::size_t>(std::max(0, decimal.power + 1 - count)), '0');
    fixed.insert(static_cast<std::size_t>(decimal.power) + 1, ".");
  } else {
    fixed = scientific;
  }
  return (decimal.is_negative ? "-" : "") + (fixed.size() <= scientific.size() ? fixed : scientific);
}

/// The number with the most digits that a large field holds.
std::string large_number(double value) {
  if (value == 0) return "0.";
  constexpr int kExact = 17;
  std::string text = nastran_form(decimal_of(value, 0));
  for (int digits = kExact - 1; text.size() > kLarge; --digits) text = nastran_form(decimal_of(value, digits));
  return text;
}

class BdfWriter {
 public:
  BdfWriter(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& out)
      : mesh_(mesh),
        options_(options),
        tags_(make_tags(mesh)),
        parts_(make_parts(mesh, tags_)),
        out_(out),
        are_ids_large_(std::max(mesh.vertices.size(), mesh.tets.size() + mesh.boundary_facets.size()) > kMostInSmall) {}

  void write() {
    out_ << "$ " << header_line(options_) << "\nCEND\nBEGIN BULK\n";
    write_materials();
    write_properties();
    write_nodes();
    const auto write_tets = [&](const PartTag& part, std::span<const std::uint32_t> tets) {
      for (const std::uint32_t tet : tets)
        write_element("CTETRA", std::uint64_t{tet} + 1, part.tag, nodes_of_tet(mesh_, tet));
    };
    for_each_group(parts_.parts, parts_.part_of_tet, parts_.tets_in, write_tets);
    const std::uint64_t first_shell = std::uint64_t{mesh_.tets.size()} + 1;
    const FacetNodes nodes(mesh_);
    const std::string_view shell = is_second_order(mesh_) ? "CTRIA6" : "CTRIA3";
    for_each_surface(tags_, [&](const SurfaceTag& surface, std::span<const std::uint32_t> facets) {
      for (const std::uint32_t facet : facets) {
        write_element(shell, first_shell + facet, surface.tag, nodes.of(facet));
      }
    });
    write_sets(first_shell);
    out_ << "ENDDATA\n";
  }

 private:
  /// SET1 cards, numbered from 1; a comment before each says its name and what it holds.
  void write_sets(std::uint64_t first_shell) {
    int number = 0;
    for (const auto& [name, set] : sets_and_materials(mesh_, tags_)) {
      write_set(++number, name + ", nodes", set.vertices, 1);
      write_set(++number, name + ", triangles", set.facets, first_shell);
      write_set(++number, name + ", tetrahedra", set.tets, 1);
    }
    for (const auto& [name, curve] : curves_as_sets(mesh_, tags_)) {
      write_set(++number, name + ", nodes", curve.vertices, 1);
    }
    if (mesh_.materials.empty()) return;  // regions are properties then
    for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> tets) {
      write_set(++number, volume.name + ", tetrahedra", {tets.begin(), tets.end()}, 1);
    });
  }

  void write_set(int number, const std::string& name, const std::vector<std::uint32_t>& members, std::uint64_t first) {
    if (members.empty()) return;
    out_ << "$ set " << number << ": " << name << '\n';
    write_card("SET1", are_ids_large_);
    write_field(number, are_ids_large_);
    const std::size_t per_line = are_ids_large_ ? 4 : 8;
    std::size_t column = 1;
    for (const std::uint32_t member : members) {
      if (column == per_line) {
        out_ << (are_ids_large_ ? "\n*       " : "\n        ");
        column = 0;
      }
      write_field(first + member, are_ids_large_);
      ++column;
    }
    out_ << '\n';
  }

  void write_properties() {
    for (const PartTag& part : parts_.parts) {
      const int material = part.material ? static_cast<int>(*part.material) + 1 : part.tag;
      write_property("PSOLID", part.tag, part.name, material);
    }
    for (const SurfaceTag& surface : tags_.surfaces) {
      write_property("PSHELL", surface.tag, surface.name, surface.tag);
    }
  }

  /// Isotropic, linear, where the constants are known: E, G (which follows), Poisson's ratio, density.
  void write_materials() {
    for (std::size_t m = 0; m < mesh_.materials.size() && options_.with_material_constants; ++m) {
      const MeshMaterial& material = mesh_.materials[m];
      if (!(material.youngs_modulus_mpa > 0)) continue;
      out_ << "$ material " << m + 1 << ": " << tags_.material_names[m] << '\n';
      write_card("MAT1", true);
      write_field(m + 1, true);
      write_real(material.youngs_modulus_mpa);
      pad(0, true);
      write_real(material.poissons_ratio);
      out_ << "\n*       ";
      if (material.density_tonne_per_mm3 > 0) out_ << large_number(material.density_tonne_per_mm3);
      out_ << '\n';
    }
  }

  void write_real(double value) {
    const std::string text = large_number(value);
    out_ << text;
    pad(text.size(), true);
  }

  /// A property that asks for a material: without materials of the mesh for that of its own number.
  void write_property(std::string_view card, int tag, const std::string& name, int material) {
    out_ << "$ property " << tag << ": " << name << '\n';
    const bool is_large = static_cast<std::uint64_t>(tag) > kMostInSmall;
    write_card(card, is_large);
    write_field(tag, is_large);
    out_ << material << (is_large ? "\n*\n" : "\n");
  }

  void write_nodes() {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const Point p = in_space(mesh_.vertices[v], options_);
      write_card("GRID", true);
      write_field(std::uint64_t{v} + 1, true);
      pad(0, true);  // the basic coordinate system
      write_real(p.x);
      write_real(p.y);
      out_ << "\n*       " << large_number(p.z) << '\n';
    }
  }

  void write_element(std::string_view card, std::uint64_t id, int property, const ElementNodes& nodes) {
    const bool is_large = are_ids_large_ || static_cast<std::uint64_t>(property) > kMostInSmall;
    write_card(card, is_large);
    write_field(id, is_large);
    write_field(property, is_large);
    const std::size_t per_line = is_large ? 4 : 8;
    for (std::size_t i = 0; i < nodes.count; ++i) {
      if ((i + 2) % per_line == 0) out_ << (is_large ? "\n*       " : "+\n+       ");
      if (i + 1 < nodes.count) {
        write_field(std::uint64_t{nodes.all[i]} + 1, is_large);
      } else {
        out_ << std::uint64_t{nodes.all[i]} + 1 << '\n';
      }
    }
    if (is_large && nodes.count == 10) out_ << "*\n";  // wide lines come in pairs
  }

  void write_card(std::string_view name, bool is_large) {
    out_ << name;
    if (is_large) out_ << '*';
    pad(name.size() + (is_large ? 1 : 0), false);
  }

  template <std::integral Number>
  void write_field(Number value, bool is_large) {
    char text[32];
    const auto size = static_cast<std::size_t>(std::to_chars(text, text + sizeof text, value).ptr - text);
    out_ << std::string_view(text, size);
    pad(size, is_large);
  }

  void pad(std::size_t used, bool is_large) {
    constexpr std::string_view kBlanks = "                ";
    out_ << kBlanks.substr(0, (is_large ? kLarge : kSmall) - used);
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  MeshParts parts_;
  TextWriter out_;
  bool are_ids_large_;
};

}  // namespace

void write_bdf(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  write_file(
      path, [&](std::ostream& out) { BdfWriter(mesh, options, out).write(); }, options.set);
}

}  // namespace scantet
