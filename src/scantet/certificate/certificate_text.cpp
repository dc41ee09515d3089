#include "scantet/certificate/certificate_text.h"

#include <algorithm>

#include "scantet/base/options.h"

namespace scantet {
namespace {

constexpr std::size_t kShownFindings = 30;
constexpr std::size_t kShownPlaces = 5;

std::string mm(double value) {
  return number_text(value, 4) + " mm";
}

std::string place_text(const Point& p) {
  return "(" + number_text(p.x, 6) + ", " + number_text(p.y, 6) + ", " + number_text(p.z, 6) + ")";
}

std::string share_text(double part, double whole) {
  return number_text(whole > 0 ? 100 * part / whole : 0, 6) + " %";
}

std::string distance_text(const VerifiedDistance& d) {
  std::string text = d.upper_mm ? "at most " + mm(*d.upper_mm) + ", proved" : "not bounded";
  if (d.upper_mm) text += " (largest near " + place_text(d.upper_place) + ")";
  if (d.lower_mm > 0) text += "; at least " + mm(d.lower_mm) + " at " + place_text(d.lower_place);
  return text;
}

std::string count_text(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string invariants_text(const VerifiedInvariants& i) {
  if (!i.is_known)
    return "components and cavities are not known for sure: values are at the level, or too close to tell";
  return count_text(i.components, "component", "components") + ", " + count_text(i.cavities, "cavity", "cavities") +
         ", Euler number " + std::to_string(i.euler) + " (" + count_text(i.handles(), "handle", "handles") + ")";
}

std::string volume_text(const std::array<double, 2>& v) {
  return number_text(v[0], 8) + " to " + number_text(v[1], 8) + " mm^3";
}

std::string left_out_text(const Certificate& c) {
  std::string text;
  if (c.components_left_out > 0) {
    text = count_text(static_cast<std::int64_t>(c.components_left_out), "component", "components");
  }
  if (c.cavities_filled > 0) {
    text += (text.empty() ? "" : ", ") +
            count_text(static_cast<std::int64_t>(c.cavities_filled), "filled cavity", "filled cavities");
  }
  const LeftOutPart& largest = c.left_out.front();
  return text + ", as was allowed; the largest has " + number_text(largest.volume_mm3, 6) + " mm^3, at " +
         place_text(largest.place);
}

/// What is known of a finding.
std::string verdict(const VerifyFinding& f) {
  return f.is_wrong ? "wrong: " : f.is_found ? "found: " : "not proved: ";
}

std::string findings_text(const Certificate& c) {
  std::string text;
  for (std::size_t n = 0; n < std::min(c.findings.size(), kShownFindings); ++n) {
    const VerifyFinding& f = c.findings[n];
    text += verdict(f) + f.what + " [" + f.code + "]";
    text += f.count > 1 ? "; " + std::to_string(f.count) + " places, one at " : "; at ";
    text += place_text(f.place) + "\n";
  }
  return text;
}

std::string region_text(const VerifiedRegion& r) {
  const auto [least, most] = r.field_components;
  std::string text = std::to_string(r.voxels_kept) + " of " + std::to_string(r.voxels) +
                     " voxels kept; parts: " + std::to_string(least) +
                     (most == least ? "" : " to " + std::to_string(most)) + " in the label map, " +
                     std::to_string(r.mesh_components) + " in the mesh; mesh to field " +
                     distance_text(r.mesh_to_field) + "; field to mesh " + distance_text(r.field_to_mesh);
  if (r.region != kOutside) {
    text += "; volume " + volume_text(r.field_volume_mm3) + ", in the mesh " + volume_text(r.mesh_volume_mm3);
  }
  return text;
}

/// Of a label map.
std::string regions_text(const Certificate& c) {
  constexpr std::size_t kShownRegions = 40;
  std::string text = "grade         " + name_of(c.grade) + "\n";
  text += "mesh to field " + distance_text(c.mesh_to_level) + "\n";
  text += "field to mesh " + distance_text(c.level_to_mesh) + "\n";
  for (std::size_t n = 0; n < std::min(c.regions.size(), kShownRegions); ++n) {
    const VerifiedRegion& r = c.regions[n];
    text += (r.region == kOutside ? "outside" : "label " + std::to_string(r.region)) + ": " + region_text(r) + "\n";
  }
  if (c.regions.size() > kShownRegions) {
    text += "and " + std::to_string(c.regions.size() - kShownRegions) + " more; --json has all\n";
  }
  text += "handles       not compared\n";
  return text + "time          " + number_text(c.seconds, 3) + " s\n" + findings_text(c);
}

/// Of a closed surface.
std::string surface_text(const Certificate& c) {
  std::string text = "grade             " + name_of(c.grade) + "\n";
  text += "mesh to surface   " + distance_text(c.mesh_to_level) + "\n";
  text += "surface to mesh   " + distance_text(c.level_to_mesh) + "\n";
  text += "surface           " + invariants_text(c.field) + "\n";
  text += "mesh              " + invariants_text(c.mesh) + "\n";
  text += "within surface    " + volume_text(c.field_volume_mm3) + "\n";
  text += "mesh's volume     " + volume_text(c.mesh_volume_mm3) + "\n";
  return text + "time              " + number_text(c.seconds, 3) + " s\n" + findings_text(c);
}

}  // namespace

CertificateGrade MeshCertificate::grade() const {
  CertificateGrade least = CertificateGrade::certified;
  for (const Certificate& c : certificates) least = std::max(least, c.grade);
  return least;
}

bool reaches(CertificateGrade grade, CertificateGrade required) {
  return static_cast<int>(grade) <= static_cast<int>(required);
}

std::string certificate_text(const Certificate& c) {
  if (!c.regions.empty()) return regions_text(c);
  if (c.is_of_surface) return surface_text(c);
  std::string text;
  const auto line = [&](const std::string& name, const std::string& value) {
    text += name + std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') + value + "\n";
  };
  line("grade", name_of(c.grade));
  line("facets", std::to_string(c.facets_certified) + " of " + std::to_string(c.facets) + " with a collar (" +
                     share_text(c.area_certified_mm2, c.area_mm2) + " of the area)");
  if (c.facets_at_border > 0) {
    line("border", std::to_string(c.facets_at_border) +
                       " facets lie beyond the outermost voxels, where the field is continued to the outside value");
  }
  line("mesh to level", distance_text(c.mesh_to_level));
  line("level to mesh", distance_text(c.level_to_mesh));
  line("scan", invariants_text(c.field));
  line("mesh", invariants_text(c.mesh));
  if (!c.left_out.empty()) line("left out", left_out_text(c));
  line("scan's volume", volume_text(c.field_volume_mm3));
  line("mesh's volume", volume_text(c.mesh_volume_mm3));
  line("time", number_text(c.seconds, 3) + " s");
  text += findings_text(c);
  for (std::size_t n = 0; n < std::min(c.undecided.size(), kShownPlaces); ++n) {
    const UndecidedPlace& place = c.undecided[n];
    text += (n == 0 ? "largest undecided facets: " : "                          ") + place.reason + " within " +
            place_text(place.box.min) + " to " + place_text(place.box.max) + "\n";
  }
  return text;
}

std::string certificate_text(const MeshCertificate& c) {
  if (c.certificates.size() == 1) return certificate_text(c.certificates.front());
  std::string text = "grade         " + name_of(c.grade()) + ", the least of all levels\n";
  for (std::size_t n = 0; n < c.certificates.size(); ++n) {
    text += "\nlevel         " + number_text(c.levels[n]) + "\n" + certificate_text(c.certificates[n]);
  }
  return text;
}

std::string certificate_summary(const Certificate& c) {
  std::string text = name_of(c.grade) + ": ";
  if (c.is_of_surface) {
    text += count_text(c.mesh.components, "component", "components") + " of " + std::to_string(c.field.components) +
            ", " + count_text(c.mesh.cavities, "cavity", "cavities") + " of " + std::to_string(c.field.cavities) +
            ", Euler number " + std::to_string(c.mesh.euler) + " of " + std::to_string(c.field.euler);
  } else if (c.regions.empty()) {
    text += std::to_string(c.facets_certified) + " of " + std::to_string(c.facets) + " facets have a collar";
  } else {
    text += std::to_string(c.regions.size() - 1) + " labels, each with the same parts as in the label map";
    if (c.grade > CertificateGrade::bounded) text = name_of(c.grade) + ": labels";
  }
  const auto distance = [](const VerifiedDistance& d) { return d.upper_mm ? "at most " + mm(*d.upper_mm) : "unknown"; };
  const std::string other = c.is_of_surface ? "surface" : "level";
  text +=
      "; mesh to " + other + " " + distance(c.mesh_to_level) + ", " + other + " to mesh " + distance(c.level_to_mesh);
  if (!c.left_out.empty()) text += "; left out: " + left_out_text(c);
  for (const VerifyFinding& f : c.findings) {
    text += "; " + verdict(f) + f.what + " [" + f.code + "]";
  }
  return text;
}

}  // namespace scantet
