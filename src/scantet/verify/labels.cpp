// The order: the mesh in itself, voxels' centres, parts of regions and which of the mesh's they are, distances,
// volumes.
#include "scantet/verify/labels.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/verify/check_input.h"
#include "scantet/verify/crossings.h"
#include "scantet/verify/findings.h"
#include "scantet/verify/label_distances.h"
#include "scantet/verify/label_mesh.h"
#include "scantet/verify/label_parts.h"
#include "scantet/verify/label_volumes.h"

namespace scantet {
namespace verify {
namespace {

class LabelVerification {
 public:
  LabelVerification(const TetMesh& mesh, const LabelSource& labels, const VerifyOptions& options, Progress& progress)
      : mesh_(mesh), labels_(labels), options_(options), progress_(progress) {}

  Certificate run() {
    say("elements");
    c_.tets = mesh_.tets.size();
    const bool is_sound = check_complex();
    regions_ = mesh_regions(mesh_);
    c_.facets = regions_.faces.size();
    say("voxels");
    count_voxels();
    if (progress_.cancelled()) return c_;
    say("parts of the field");
    const LabelParts parts = label_parts(labels_, c_.findings, progress_);
    if (progress_.cancelled()) return c_;
    const bool is_matched = match(parts);
    say("distances");
    const bool has_bounds = measure();
    if (progress_.cancelled()) return c_;
    check_distance();
    c_.regions = {};
    for (auto& [region, proved] : of_) c_.regions.push_back(proved);
    grade(is_sound && is_matched && has_bounds);
    return c_;
  }

 private:
  void say(const char* doing) { progress_.report({"verify", doing, 0, std::nullopt, 0}); }

  /// Whether tets are positive, share faces properly and overlap nowhere.
  bool check_complex() {
    TetMesh one;  // of one region
    one.vertices = mesh_.vertices;
    one.tets = mesh_.tets;
    one.tet_regions.assign(one.tets.size(), 1);
    const Shell shell = make_shell(one, c_.findings);
    if (shell.facets.empty()) {  // tets that cancel each other out
      FindingList(c_.findings).add("boundary.none", "the mesh has no boundary", mesh_.vertices[mesh_.tets[0][0]]);
      return false;
    }
    for (VerifyFinding& finding : c_.findings) {  // regions may touch themselves along an edge, as the label map has it
      if (finding.code == "boundary.edge" || finding.code == "boundary.vertex") finding.is_wrong = false;
    }
    if (shell.is_manifold) {
      outside_parts_ =
          static_cast<std::int64_t>(shell.first.size()) + 1 - static_cast<std::int64_t>(shell.tet_components);
    }
    const BoundaryRays rays(one, shell);
    if (!shell.is_closed || !check_coverage(one, shell, rays, c_.findings) || !shell.is_manifold) return false;
    const std::vector<std::uint8_t> all(shell.facets.size(), 1);
    return check_crossings(one, shell, rays, all, c_.findings, progress_);
  }

  Region label_of(std::size_t voxel, std::array<int, 3>& node) const {
    const auto row = static_cast<std::size_t>(labels_.size()[0]);
    const auto rows = static_cast<std::size_t>(labels_.size()[1]);
    node = {static_cast<int>(voxel % row), static_cast<int>(voxel / row % rows), static_cast<int>(voxel / row / rows)};
    return labels_.region_of(node[0], node[1], node[2]);
  }

  void count_voxels() {
    FindingList findings(c_.findings);
    places_ = voxel_places(mesh_, labels_, progress_);
    far_ = far_layers();
    of_[kOutside].region = kOutside;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      of_[mesh_.tet_regions[t]].region = mesh_.tet_regions[t];
      if (mesh_.tet_regions[t] != kOutside) continue;
      findings.add("region.outside", "tets have the outside's number as their region",
                   mesh_.vertices[mesh_.tets[t][0]]);
    }
    for (std::size_t v = 0; v < places_.size(); ++v) {
      std::array<int, 3> node{};
      const Region region = label_of(v, node);
      VerifiedRegion& proved = of_[region];
      proved.region = region;
      ++proved.voxels;
      const VoxelPlace& place = places_[v];
      const bool is_in_mesh = place.tet != VoxelPlace::kNoTet;
      if (is_in_mesh ? place.has_label : region == kOutside) {
        ++proved.voxels_kept;
      } else if (is_in_mesh && place.is_on_face && region == kOutside) {
        ++proved.voxels_on_face;
      } else {
        const Point p = labels_.frame().to_world({double(node[0]), double(node[1]), double(node[2])});
        findings.add_found("voxel.changed", "voxels' centres lie in another region of the mesh", p);
        if (is_deep(node, region)) {
          findings.add("voxel.far",
                       "centres of voxels lie in another region, farther within their own than the mesh's longest "
                       "boundary edge and a voxel",
                       p);
        }
      }
    }
  }

  /// How many voxels to all sides are farther than the longest edge of a face and the diagonal of a voxel.
  int far_layers() const {
    const Frame& frame = labels_.frame();
    double most = 0;
    for (int turn = 0; turn < 4; ++turn) {
      most = std::max(most, length(frame.column(0) + (turn & 1 ? -1.0 : 1.0) * frame.column(1) +
                                   (turn & 2 ? -1.0 : 1.0) * frame.column(2)));
    }
    for (const RegionFace& face : regions_.faces) {
      for (std::size_t n = 0; n < 3; ++n) {
        most = std::max(most, distance(mesh_.vertices[face.corners[n]], mesh_.vertices[face.corners[(n + 1) % 3]]));
      }
    }
    double apart = HUGE_VAL;  // of planes of voxels
    for (int axis = 0; axis < 3; ++axis) {
      apart = std::min(apart, std::abs(frame.determinant_mm3()) /
                                  length(cross(frame.column((axis + 1) % 3), frame.column((axis + 2) % 3))));
    }
    return static_cast<int>(std::min(1e6, std::ceil(most / apart * (1 + 1e-9)) + 1));
  }

  bool is_deep(const std::array<int, 3>& node, Region region) const {
    if (region != kOutside) {  // it would have to be larger than the image
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (node[axis] < far_ || node[axis] + far_ >= labels_.size()[axis]) return false;
      }
    } else if (far_ > *std::max_element(labels_.size().begin(), labels_.size().end())) {
      return false;
    }
    for (const int step : {far_, 1}) {  // corners and middles first
      if (!is_all_around(node, region, step)) return false;
    }
    return true;
  }

  bool is_all_around(const std::array<int, 3>& node, Region region, int step) const {
    for (int k = -far_; k <= far_; k += step) {
      for (int j = -far_; j <= far_; j += step) {
        for (int i = -far_; i <= far_; i += step) {
          if (labels_.region_of(node[0] + i, node[1] + j, node[2] + k) != region) return false;
        }
      }
    }
    return true;
  }

  /// Whether parts of the label map and parts of the mesh are the same, one to one.
  bool match(const LabelParts& parts) {
    FindingList findings(c_.findings);
    std::vector<std::set<std::uint32_t>> met(parts.parts.size());  // parts of the mesh that hold its voxels
    std::map<std::uint32_t, std::uint32_t> part_of_mesh;           // the part of the label map that it is of
    bool is_one_to_one = true;
    const std::array<int, 3>& size = labels_.size();
    std::size_t voxel = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(size[2]); ++k) {
      for (std::size_t j = 0; j < static_cast<std::size_t>(size[1]); ++j) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(size[0]); ++i, ++voxel) {
          const VoxelPlace& place = places_[voxel];
          if (place.tet == VoxelPlace::kNoTet || place.is_on_face || !place.has_label) continue;
          const std::size_t node =
              ((k + 1) * (static_cast<std::size_t>(size[1]) + 2) + j + 1) * (static_cast<std::size_t>(size[0]) + 2) +
              i + 1;
          const std::uint32_t part = parts.part_of[node];
          const std::uint32_t of_mesh = regions_.part_of[place.tet];
          met[part].insert(of_mesh);
          if (part_of_mesh.try_emplace(of_mesh, part).first->second == part) continue;
          is_one_to_one = false;
          findings.add_undecided("component.joined", "voxels of several parts of a label lie in one part of the mesh",
                                 mesh_.vertices[mesh_.tets[place.tet][0]], false);
        }
      }
    }
    count_parts(parts);
    for (std::size_t n = 0; n < parts.parts.size(); ++n) {
      const LabelParts::Part& part = parts.parts[n];
      if (part.region == kOutside || met[n].size() == 1) continue;
      is_one_to_one = false;
      const Point p = labels_.frame().to_world({double(part.node[0]), double(part.node[1]), double(part.node[2])});
      if (met[n].empty()) {
        findings.add_undecided("component.unmatched", "parts of labels have no voxel's centre in the mesh", p, false);
      } else {
        findings.add_undecided("component.split", "voxels of one part of a label lie in several parts of the mesh", p,
                               false);
      }
    }
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (part_of_mesh.count(regions_.part_of[t]) != 0) continue;
      is_one_to_one = false;
      findings.add_undecided("component.empty", "parts of the mesh hold no voxel's centre of their label",
                             mesh_.vertices[mesh_.tets[t][0]], false);
      part_of_mesh[regions_.part_of[t]] = 0;
    }
    return check_counts(parts) && is_one_to_one;
  }

  void count_parts(const LabelParts& parts) {
    std::map<Region, std::set<std::uint32_t>> groups;
    for (const LabelParts::Part& part : parts.parts) {
      ++of_[part.region].field_components[1];
      groups[part.region].insert(part.group);
    }
    for (const auto& [region, list] : groups) of_[region].field_components[0] = static_cast<std::int64_t>(list.size());
    for (const Region region : regions_.parts) ++of_[region].mesh_components;
    of_[kOutside].mesh_components = outside_parts_.value_or(0);
  }

  bool check_counts(const LabelParts& parts) {
    FindingList findings(c_.findings);
    bool is_same = true;
    std::map<Region, Point> place_of;
    for (const LabelParts::Part& part : parts.parts) {
      place_of.try_emplace(
          part.region, labels_.frame().to_world({double(part.node[0]), double(part.node[1]), double(part.node[2])}));
    }
    for (const auto& [region, proved] : of_) {
      const auto [least, most] = proved.field_components;
      const std::string name = region == kOutside ? "the outside" : "label " + std::to_string(region);
      const Point place = place_of.count(region) != 0 ? place_of[region] : first_vertex_of(region);
      c_.field.components += region == kOutside ? 0 : least;
      c_.mesh.components += region == kOutside ? 0 : proved.mesh_components;
      if (region == kOutside && !outside_parts_) {
        is_same = false;  // boundary.edge or boundary.vertex says why
      } else if (most == 0) {
        findings.add("region.unknown", "the mesh has regions that no voxel has", place);
      } else if (proved.mesh_components == 0) {
        findings.add("region.missing", "the mesh has no tet of labels that voxels have", place);
      } else if (proved.mesh_components < least) {
        findings.add("component.missing", name + " has fewer parts in the mesh than in the label map", place);
      } else if (least != most) {
        findings.add_undecided("component.count",
                               "how many parts a label has is not decided: where they only touch, " + name + " has " +
                                   std::to_string(least) + " to " + std::to_string(most),
                               place, false);
      } else if (proved.mesh_components != least) {
        findings.add_undecided("component.extra", name + " has more parts in the mesh than in the label map", place,
                               false);
      }
      is_same = is_same && least == most && least == proved.mesh_components;
      c_.field.is_known = c_.field.is_known && least == most;
    }
    return is_same;
  }

  Point first_vertex_of(Region region) const {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (mesh_.tet_regions[t] == region) return mesh_.vertices[mesh_.tets[t][0]];
    }
    return mesh_.vertices[mesh_.tets[0][0]];
  }

  /// Whether all distances are bounded.
  bool measure() {
    const LabelDistances distances(mesh_, regions_, labels_);
    const auto from_mesh = distances.from_mesh(progress_);
    const auto from_field = distances.from_field(progress_);
    const auto of_mesh = region_volumes(mesh_);
    const auto of_field = region_volumes(labels_, progress_);
    const auto take = [](const std::map<Region, ProvedDistance>& all, Region region, VerifiedDistance& d) {
      const auto found = all.find(region);
      if (found == all.end()) return;
      d.upper_mm = found->second.upper_mm;
      d.upper_place = found->second.place;
    };
    const auto widen = [](VerifiedDistance& most, const VerifiedDistance& d, bool is_first) {
      if (!is_first && (!most.upper_mm || (d.upper_mm && *d.upper_mm <= *most.upper_mm))) return;
      most = d;
    };
    bool is_first = true;
    for (auto& [region, proved] : of_) {
      take(from_mesh, region, proved.mesh_to_field);
      take(from_field, region, proved.field_to_mesh);
      if (of_mesh.count(region) != 0) proved.mesh_volume_mm3 = of_mesh.at(region);
      if (of_field.count(region) != 0) proved.field_volume_mm3 = of_field.at(region);
      widen(c_.mesh_to_level, proved.mesh_to_field, is_first);
      widen(c_.level_to_mesh, proved.field_to_mesh, is_first);
      is_first = false;
      if (region == kOutside) continue;
      for (std::size_t n = 0; n < 2; ++n) {
        c_.mesh_volume_mm3[n] += proved.mesh_volume_mm3[n];
        c_.field_volume_mm3[n] += proved.field_volume_mm3[n];
      }
    }
    FindingList findings(c_.findings);
    for (const VerifiedDistance* d : {&c_.mesh_to_level, &c_.level_to_mesh}) {
      if (d->upper_mm) continue;
      findings.add_undecided("distance.unbounded",
                             "how far the boundaries of a region in the mesh and in the label map are from each other "
                             "could not be bounded",
                             d->upper_place, false);
    }
    return c_.mesh_to_level.upper_mm && c_.level_to_mesh.upper_mm;
  }

  void check_distance() {
    if (!options_.max_distance_mm) return;
    FindingList findings(c_.findings);
    for (const VerifiedDistance* d : {&c_.mesh_to_level, &c_.level_to_mesh}) {
      if (d->upper_mm && *d->upper_mm <= *options_.max_distance_mm) continue;
      findings.add_undecided("distance.not_shown",
                             "boundaries of regions are not shown to be within " +
                                 number_text(*options_.max_distance_mm, 4) + " mm of each other",
                             d->upper_place, false);
    }
  }

  void grade(bool is_bounded) {
    c_.grade = is_bounded ? CertificateGrade::bounded : CertificateGrade::undecided;
    for (const VerifyFinding& finding : c_.findings) {
      if (!finding.is_wrong && !finding.bounded) c_.grade = std::max(c_.grade, CertificateGrade::undecided);
      if (finding.is_wrong) c_.grade = CertificateGrade::not_the_scan;
    }
  }

  const TetMesh& mesh_;
  const LabelSource& labels_;
  const VerifyOptions& options_;
  Progress& progress_;
  MeshRegions regions_;
  std::vector<VoxelPlace> places_;
  std::map<Region, VerifiedRegion> of_;
  std::optional<std::int64_t> outside_parts_;  // none: not known, as the boundary is no surface
  int far_ = 0;
  Certificate c_;
};

}  // namespace
}  // namespace verify

Certificate verify_labels(const TetMesh& mesh, const LabelSource& labels, const VerifyOptions& options,
                          Progress& progress) {
  verify::check_mesh(mesh);
  const auto begin = std::chrono::steady_clock::now();
  Certificate certificate = verify::LabelVerification(mesh, labels, options, progress).run();
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return certificate;
}

}  // namespace scantet
