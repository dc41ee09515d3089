// The order: the mesh in itself, what the field consists of, the collar, then distances where there is none. The grade
// is what all of this proves together.
#include "scantet/verify/verify.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/verify/check_input.h"
#include "scantet/verify/collar.h"
#include "scantet/verify/comparison.h"
#include "scantet/verify/crossings.h"
#include "scantet/verify/distances.h"
#include "scantet/verify/findings.h"
#include "scantet/verify/shell.h"
#include "scantet/verify/volumes.h"

namespace scantet {
namespace verify {
namespace {

constexpr std::size_t kWitnesses = 12;  // facets that lower bounds of distances are taken from

class Verification {
 public:
  Verification(const TetMesh& mesh, const Scan& scan, const VerifyOptions& options, Progress& progress)
      : mesh_(mesh),
        options_(options),
        progress_(progress),
        nodes_(scan, options.level, options.is_capped),
        map_(scan.frame) {}

  Certificate run() {
    say("elements");
    shell_ = make_shell(mesh_, c_.findings);
    c_.tets = mesh_.tets.size();
    c_.facets = shell_.facets.size();
    if (shell_.facets.empty()) {  // tets that cancel each other out
      FindingList(c_.findings).add("boundary.none", "the mesh has no boundary", mesh_.vertices[mesh_.tets[0][0]]);
      c_.grade = CertificateGrade::not_the_scan;
      return c_;
    }
    if (options_.only_collars) {
      const CollarInput input = collar_input(mesh_, shell_, nodes_, map_, left_out_.sides);
      count_facets(input, find_collar(input, options_.rounds, progress_));
      return c_;
    }
    rays_.emplace(mesh_, shell_);
    covers_once_ = shell_.is_closed && check_coverage(mesh_, shell_, *rays_, c_.findings);
    c_.mesh_volume_mm3 = mesh_volume(mesh_);
    if (progress_.cancelled()) return c_;
    say("parts of the field");
    const VoxelNodes asked = nodes_;
    take(compare_parts(mesh_, shell_, *rays_, nodes_, options_.left_out, progress_));
    if (nodes_.level() != asked.level()) as_asked_ = asked;
    if (progress_.cancelled()) return c_;
    c_.field_volume_mm3 = field_volume(nodes_, progress_);
    const CollarInput input = collar_input(mesh_, shell_, nodes_, map_, left_out_.sides);
    const Collar collar = find_collar(input, options_.rounds, progress_);
    if (progress_.cancelled()) return c_;
    look_at(input, collar);
    return c_;
  }

 private:
  void say(const char* doing) { progress_.report({"verify", doing, 0, std::nullopt, 0}); }

  void take(Comparison&& found) {
    left_out_ = std::move(found.left_out);
    for (const LeftOutPart& part : left_out_.list) ++(part.is_cavity ? c_.cavities_filled : c_.components_left_out);
    c_.left_out = left_out_.list;
    if (c_.left_out.size() > options_.most_places) c_.left_out.resize(options_.most_places);
    matching_ = found.matching;
    c_.field = matching_.field;
    c_.mesh = matching_.mesh;
    c_.findings.insert(c_.findings.end(), found.findings.begin(), found.findings.end());
  }

  /// Whether the collars part what is left from what was left out (docs/certificate.md, (4')).
  bool leaves_out_soundly(const CollarInput& input, const Collar& collar) {
    if (left_out_.list.empty()) return true;
    if (left_out_.is_sound && !may_hold(input, collar, left_out_.places)) return true;
    FindingList(c_.findings)
        .add_undecided("left_out.close", "what was left out is not shown to be apart from the mesh's boundary",
                       left_out_.list.front().place, true);
    return false;
  }

  void look_at(const CollarInput& input, Collar collar) {
    say("distances");
    bound_distances(input, collar, progress_);
    count_facets(input, collar);
    check_vertices(input, collar);
    const bool all = c_.facets_certified == c_.facets;
    const bool is_embedded =
        shell_.is_manifold && (all || check_crossings(mesh_, shell_, *rays_, collar.faults, c_.findings, progress_));
    const bool is_apart = leaves_out_soundly(input, collar);
    measure(input, collar,
            all && is_apart && shell_.is_manifold && covers_once_ && matching_.has_same_counts && c_.field.is_known);
    if (progress_.cancelled()) return;
    check_distance();
    grade(all, is_embedded);
  }

  void count_facets(const CollarInput& input, const Collar& collar) {
    struct Place {
      double area;
      std::size_t facet;
    };
    std::vector<Place> places;
    for (std::size_t f = 0; f < shell_.facets.size(); ++f) {
      std::array<Point, 3> p;
      bool is_at_border = false;
      for (std::size_t n = 0; n < 3; ++n) {
        p[n] = mesh_.vertices[shell_.vertices[shell_.facets[f][n]]];
        const Vec index = input.places[shell_.facets[f][n]].middle();
        for (int axis = 0; axis < 3; ++axis) {
          is_at_border =
              is_at_border || index[axis] < 0 || index[axis] > nodes_.size()[static_cast<std::size_t>(axis)] - 1;
        }
      }
      c_.facets_at_border += is_at_border;
      const double area = 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
      c_.area_mm2 += area;
      if (collar.faults[f] == 0) {
        ++c_.facets_certified;
        c_.area_certified_mm2 += area;
      } else {
        places.push_back({area, f});
      }
    }
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.area > b.area; });
    if (places.size() > options_.most_places) places.resize(options_.most_places);
    for (const Place& place : places) {
      UndecidedPlace undecided;
      for (const VertexId v : shell_.facets[place.facet]) undecided.box.extend(mesh_.vertices[shell_.vertices[v]]);
      const std::uint8_t faults = collar.faults[place.facet];
      undecided.reason = faults & kVertex    ? "vertex"
                         : faults & kFold    ? "fold"
                         : faults & kCrowded ? "crowded"
                         : faults & kSlope   ? "slope"
                                             : "value";
      c_.undecided.push_back(undecided);
    }
    if (c_.undecided.empty()) return;
    FindingList findings(c_.findings);
    findings.add_undecided("facet.undecided", "boundary facets are not shown to follow the level set",
                           c_.undecided[0].box.center(), true);
    c_.findings.back().count = c_.facets - c_.facets_certified;
  }

  void check_vertices(const CollarInput& input, const Collar& collar) {
    const double tolerance = options_.vertex_tolerance_mm.value_or(1e-3 * nodes_.frame().min_spacing_mm());
    const auto off = parallel_collect<std::uint32_t>(
        shell_.vertices.size(), 512, [&](std::size_t begin, std::size_t end, auto& out) {
          for (std::size_t v = begin; v < end; ++v) {
            if (!is_near_level(input, collar, static_cast<std::uint32_t>(v), tolerance))
              out.push_back(static_cast<std::uint32_t>(v));
          }
        });
    FindingList findings(c_.findings);
    for (const std::uint32_t v : off) {
      findings.add_undecided(
          "vertex.off_level",
          "boundary vertices are not shown to be within " + number_text(tolerance, 3) + " mm of the level set",
          mesh_.vertices[shell_.vertices[v]], true);
    }
  }

  /// follows: all facets have collars, and the level set has no part elsewhere.
  void measure(const CollarInput& input, const Collar& collar, bool follows) {
    const Distances distances(input, collar, rays_->tree());
    lower_bounds(distances, collar);
    std::vector<double> bounds = collar.bound_mm;
    constexpr double kNone = -1;
    parallel_for(bounds.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end && !progress_.cancelled(); ++f) {
        if (collar.faults[f] != 0) bounds[f] = distances.bound_of_facet(f).value_or(kNone);
      }
    });
    list_bounds(bounds);
    const auto place_of = [&](std::size_t f) { return mesh_.vertices[shell_.vertices[shell_.facets[f][0]]]; };
    const auto unbounded = std::find(bounds.begin(), bounds.end(), kNone);
    const auto largest = std::max_element(bounds.begin(), bounds.end());
    const auto at = static_cast<std::size_t>((unbounded != bounds.end() ? unbounded : largest) - bounds.begin());
    c_.mesh_to_level.upper_place = place_of(at);
    if (unbounded == bounds.end()) {
      c_.mesh_to_level.upper_mm = *largest;
    } else {
      FindingList findings(c_.findings);
      findings.add_undecided("distance.unbounded", "how far a facet is from the level set could not be bounded",
                             place_of(at), false);
    }
    if (follows) {
      c_.level_to_mesh.upper_mm = c_.mesh_to_level.upper_mm;
      c_.level_to_mesh.upper_place = c_.mesh_to_level.upper_place;
    } else {
      double aim = 0.2 * nodes_.frame().min_spacing_mm();
      for (std::size_t f = 0; f < bounds.size(); ++f) aim = std::max(aim, collar.faults[f] == 0 ? bounds[f] : 0);
      Point place;
      c_.level_to_mesh.upper_mm = distances.bound_of_level(aim, progress_, place);
      c_.level_to_mesh.upper_place = place;
    }
  }

  void list_bounds(const std::vector<double>& bounds) {
    for (std::size_t f = 0; f < bounds.size() && options_.lists_facets; ++f) {
      Triangle facet = shell_.facets[f];
      for (VertexId& v : facet) v = shell_.vertices[v];
      c_.bounds.push_back({facet, bounds[f]});
    }
  }

  void lower_bounds(const Distances& distances, const Collar& collar) {
    std::vector<std::size_t> order(collar.sampled_mm.size());
    for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
    const std::size_t count = std::min(kWitnesses, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
        [&](std::size_t a, std::size_t b) {
          return collar.sampled_mm[a] != collar.sampled_mm[b] ? collar.sampled_mm[a] > collar.sampled_mm[b] : a < b;
        });
    order.resize(count);
    const std::vector<Witness> told = witnesses(distances, order);
    const std::vector<Witness> sure = as_asked_ ? witnesses_of_any_way(collar, order) : told;
    FindingList findings(c_.findings);
    for (std::size_t n = 0; n < count; ++n) {
      if (sure[n].from_mesh.lower_mm > far_from(order[n])) {
        findings.add("facet.far", "a facet is farther from the level set than its longest edge and a voxel",
                     sure[n].from_mesh.lower_place);
      }
      take_larger(told[n].from_mesh, c_.mesh_to_level);
      take_larger(told[n].from_level, c_.level_to_mesh);
      take_larger(sure[n].from_mesh, sure_from_mesh_);
      take_larger(sure[n].from_level, sure_from_level_);
    }
    for (std::size_t n = 0; n < count; ++n) {
      if (told[n].from_mesh.lower_mm <= far_from(order[n]) || sure[n].from_mesh.lower_mm > far_from(order[n])) continue;
      findings.add_undecided("facet.far",
                             "a facet is farther from the level set than its longest edge and a voxel, unless ties are "
                             "broken in another way",
                             told[n].from_mesh.lower_place, false);
    }
  }

  struct Witness {
    VerifiedDistance from_mesh;
    VerifiedDistance from_level;
  };

  static std::vector<Witness> witnesses(const Distances& distances, const std::vector<std::size_t>& facets) {
    std::vector<Witness> out(facets.size());
    parallel_for(facets.size(), 1, [&](std::size_t n, std::size_t) {
      Witness& w = out[n];
      w.from_mesh.lower_mm = distances.at_least(facets[n], w.from_mesh.lower_place);
      w.from_level.lower_mm = distances.level_at_least(facets[n], w.from_level.lower_place);
    });
    return out;
  }

  /// In the field as it is, ties at the level: a ball in which it is nowhere at the level holds no level set whichever
  /// way ties are broken, and a line between both sides crosses it. Which parts were left out hangs on the way.
  std::vector<Witness> witnesses_of_any_way(const Collar& collar, const std::vector<std::size_t>& facets) const {
    const NodeSides all;
    const CollarInput input = collar_input(mesh_, shell_, *as_asked_, map_, all);
    std::vector<Witness> out = witnesses(Distances(input, collar, rays_->tree()), facets);
    if (left_out_.sides.any()) {
      for (Witness& w : out) w.from_level = {};
    }
    return out;
  }

  static void take_larger(const VerifiedDistance& found, VerifiedDistance& best) {
    if (found.lower_mm <= best.lower_mm) return;
    best.lower_mm = found.lower_mm;
    best.lower_place = found.lower_place;
  }

  /// A facet of a mesh of the level set is nearer to it: its longest edge, or the diagonal of a voxel if that is
  /// longer.
  double far_from(std::size_t facet) const {
    const Frame& frame = nodes_.frame();
    double most = 0;
    for (int turn = 0; turn < 4; ++turn) {
      most = std::max(most, length(frame.column(0) + (turn & 1 ? -1.0 : 1.0) * frame.column(1) +
                                   (turn & 2 ? -1.0 : 1.0) * frame.column(2)));
    }
    const Triangle& t = shell_.facets[facet];
    for (std::size_t n = 0; n < 3; ++n) {
      most = std::max(most,
                      distance(mesh_.vertices[shell_.vertices[t[n]]], mesh_.vertices[shell_.vertices[t[(n + 1) % 3]]]));
    }
    return most;
  }

  void check_distance() {
    if (!options_.max_distance_mm) return;
    FindingList findings(c_.findings);
    const std::string most = number_text(*options_.max_distance_mm, 4) + " mm";
    for (const VerifiedDistance* d : {&c_.mesh_to_level, &c_.level_to_mesh}) {
      const bool from_mesh = d == &c_.mesh_to_level;
      const VerifiedDistance& sure = from_mesh ? sure_from_mesh_ : sure_from_level_;
      const std::string what = from_mesh ? "the mesh's boundary" : "the level set";
      const std::string other = from_mesh ? " of the level set" : " of the mesh's boundary";
      if (sure.lower_mm > *options_.max_distance_mm) {
        findings.add("distance.exceeded", what + " is not within " + most + other, sure.lower_place);
      } else if (!d->upper_mm || *d->upper_mm > *options_.max_distance_mm) {
        findings.add_undecided("distance.not_shown", what + " is not shown to be within " + most + other,
                               d->upper_place, false);
      }
    }
  }

  void grade(bool all_certified, bool is_embedded) {
    bool is_wrong = false;
    bool keeps_bounded = true;
    bool keeps_certified = true;
    for (const VerifyFinding& finding : c_.findings) {
      is_wrong = is_wrong || finding.is_wrong;
      keeps_certified = false;
      keeps_bounded = keeps_bounded && finding.bounded;
    }
    const bool same = matching_.has_same_counts && matching_.has_same_euler && c_.field.is_known;
    const bool sound = shell_.is_manifold && covers_once_ && is_embedded;
    const bool has_bounds = c_.mesh_to_level.upper_mm && c_.level_to_mesh.upper_mm;
    if (is_wrong) {
      c_.grade = CertificateGrade::not_the_scan;
    } else if (all_certified && sound && same && has_bounds && keeps_certified) {
      c_.grade = CertificateGrade::certified;
    } else if (sound && same && has_bounds && keeps_bounded) {
      c_.grade = CertificateGrade::bounded;
    } else {
      c_.grade = CertificateGrade::undecided;
    }
  }

  const TetMesh& mesh_;
  const VerifyOptions& options_;
  Progress& progress_;
  VoxelNodes nodes_;
  std::optional<VoxelNodes> as_asked_;  // before ties were broken, if they were
  VerifiedDistance sure_from_mesh_;     // lower bounds that hold whichever way ties are broken
  VerifiedDistance sure_from_level_;
  IndexMap map_;
  Shell shell_;
  std::optional<BoundaryRays> rays_;
  Matching matching_;
  LeftOut left_out_;
  bool covers_once_ = false;
  Certificate c_;
};

}  // namespace

void check_mesh(const TetMesh& mesh) {
  if (mesh.tets.empty())
    throw Error(Fault::input, "input.no_tets", "the mesh has no tetrahedra", "give a tetrahedral mesh");
  const bool is_consistent = mesh.tet_regions.size() == mesh.tets.size() &&
                             std::all_of(mesh.tets.begin(), mesh.tets.end(), [&](const Tet& tet) {
                               return *std::max_element(tet.begin(), tet.end()) < mesh.vertices.size();
                             });
  if (!is_consistent) {
    throw Error(Fault::internal, "mesh.inconsistent",
                "the mesh has not one region a tet, or a vertex that is not there", "build it as TetMesh says");
  }
  for (const Point& p : mesh.vertices) {
    if (is_finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1e50) continue;
    throw Error(Fault::input, "input.range", "the mesh has coordinates beyond 1e50 mm",
                "check the unit; it must be mm");
  }
}

}  // namespace verify

std::string name_of(CertificateGrade grade) {
  switch (grade) {
    case CertificateGrade::certified:
      return "certified";
    case CertificateGrade::bounded:
      return "bounded";
    case CertificateGrade::undecided:
      return "undecided";
    case CertificateGrade::not_the_scan:
      break;
  }
  return "not the scan";
}

Certificate verify_mesh(const TetMesh& mesh, const Scan& scan, const VerifyOptions& options, Progress& progress) {
  verify::check_mesh(mesh);
  const auto begin = std::chrono::steady_clock::now();
  Certificate certificate = verify::Verification(mesh, scan, options, progress).run();
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return certificate;
}

}  // namespace scantet
