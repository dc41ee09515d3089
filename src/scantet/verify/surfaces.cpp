// The order: the mesh in itself, the surface in itself, what they consist of, which surface of the mesh is which of the
// object, and the distances between these.
#include "scantet/verify/surfaces.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/verify/check_input.h"
#include "scantet/verify/crossings.h"
#include "scantet/verify/findings.h"
#include "scantet/verify/nesting.h"
#include "scantet/verify/surface_distances.h"
#include "scantet/verify/volumes.h"

namespace scantet {
namespace verify {
namespace {

/// A closed boundary: that of a mesh, or the surface itself.
struct Boundary {
  const TetMesh& points;  // of a surface, without tets
  Shell shell{};
  std::optional<BoundaryRays> rays{};
  bool is_embedded = false;
  std::optional<std::vector<std::uint32_t>> nesting{};

  std::size_t count() const { return shell.first.size(); }
  bool is_cavity(std::uint32_t surface) const { return (*nesting)[surface] % 2 == 1; }
  Point place(std::uint32_t surface) const {
    return points.vertices[shell.vertices[shell.facets[shell.first[surface]][0]]];
  }
  /// Vertices of `points`.
  Triangle facet(std::size_t f) const {
    Triangle facet = shell.facets[f];
    for (VertexId& v : facet) v = shell.vertices[v];
    return facet;
  }
  std::vector<Triangle> facets(const std::vector<std::uint32_t>& numbers) const {
    std::vector<Triangle> list;
    list.reserve(numbers.size());
    for (const std::uint32_t f : numbers) list.push_back(facet(f));
    return list;
  }
  std::vector<std::uint32_t> all_facets() const {
    std::vector<std::uint32_t> all(shell.facets.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  /// One list a surface.
  std::vector<std::vector<std::uint32_t>> facets_of_surfaces() const {
    std::vector<std::vector<std::uint32_t>> lists(count());
    for (std::uint32_t f = 0; f < shell.facets.size(); ++f) lists[shell.component[f]].push_back(f);
    return lists;
  }
};

VerifiedInvariants invariants_of(const Boundary& boundary) {
  VerifiedInvariants found;
  found.is_known = boundary.shell.is_manifold && boundary.nesting;
  if (!found.is_known) return found;
  for (std::uint32_t s = 0; s < boundary.count(); ++s) {
    ++(boundary.is_cavity(s) ? found.cavities : found.components);
    found.euler += boundary.shell.euler[s];
  }
  return found;
}

class SurfaceVerification {
 public:
  SurfaceVerification(const TetMesh& mesh, const TriangleSurface& surface, const VerifyOptions& options,
                      Progress& progress)
      : options_(options), progress_(progress), mesh_{mesh}, object_{outline_}, findings_(c_.findings) {
    outline_.vertices = surface.vertices;
    object_.shell = make_shell(outline_, surface.facets, of_object_);
    c_.is_of_surface = true;
  }

  Certificate run() {
    say("elements");
    c_.tets = mesh_.points.tets.size();
    mesh_.shell = make_shell(mesh_.points, c_.findings);
    c_.facets = mesh_.shell.facets.size();
    if (c_.facets == 0) {  // tets that cancel each other out
      findings_.add("boundary.none", "the mesh has no boundary", mesh_.points.vertices[mesh_.points.tets[0][0]]);
      c_.grade = CertificateGrade::not_the_scan;
      return c_;
    }
    mesh_.rays.emplace(mesh_.points, mesh_.shell);
    const bool covers_once =
        mesh_.shell.is_closed && check_coverage(mesh_.points, mesh_.shell, *mesh_.rays, c_.findings);
    c_.mesh_volume_mm3 = mesh_volume(mesh_.points);
    look_at(mesh_, c_.findings);
    if (progress_.cancelled()) return c_;
    say("the surface");
    look_at_object();
    if (progress_.cancelled()) return c_;
    const bool is_matched = compare();
    say("distances");
    measure(is_matched);
    if (progress_.cancelled()) return c_;
    check_distance();
    grade(is_matched && covers_once && mesh_.is_embedded && object_.is_embedded);
    return c_;
  }

 private:
  void say(const char* doing) { progress_.report({"verify", doing, 0, std::nullopt, 0}); }

  void look_at(Boundary& boundary, std::vector<VerifyFinding>& findings) {
    const std::vector<std::uint8_t> all(boundary.shell.facets.size(), 1);
    boundary.is_embedded = check_crossings(boundary.points, boundary.shell, *boundary.rays, all, findings, progress_) &&
                           boundary.shell.is_manifold;
    if (boundary.shell.is_closed) boundary.nesting = nesting(boundary.points, boundary.shell, *boundary.rays);
  }

  void look_at_object() {
    object_.rays.emplace(object_.points, object_.shell);
    look_at(object_, of_object_);
    for (const VerifyFinding& finding : of_object_) {
      findings_.add_undecided("surface." + finding.code.substr(finding.code.find('.') + 1),
                              "of the surface itself: " + finding.what, finding.place, false);
    }
    if (!object_.nesting || !mesh_.nesting) {
      findings_.add_undecided("surface.nesting", "which surfaces lie within which could not be decided",
                              object_.place(0), false);
    }
    const auto lists = object_.facets_of_surfaces();
    for (std::uint32_t s = 0; s < object_.count() && object_.nesting; ++s) {
      const std::array<double, 2> volume = enclosed_volume(outline_.vertices, object_.facets(lists[s]));
      const bool is_cavity = object_.is_cavity(s);
      c_.field_volume_mm3[0] += is_cavity ? -volume[1] : volume[0];
      c_.field_volume_mm3[1] += is_cavity ? -volume[0] : volume[1];
    }
  }

  /// Whether both have the same surfaces, one to one.
  bool compare() {
    c_.field = invariants_of(object_);
    c_.mesh = invariants_of(mesh_);
    if (!c_.field.is_known || !c_.mesh.is_known) return false;
    const bool is_matched = match();
    if (c_.field.components == c_.mesh.components && c_.field.cavities == c_.mesh.cavities) {
      if (c_.field.euler != c_.mesh.euler) {
        findings_.add("handles.differ",
                      "the mesh's boundary has another Euler number, hence other handles, than the surface",
                      mesh_.place(0));
      }
      return is_matched;
    }
    findings_.add("topology.counts", "the mesh has not as many components and cavities as the surface", mesh_.place(0));
    return false;
  }

  /// Each surface of the mesh goes with that of the object which most of its vertices are nearest to.
  bool match() {
    const TriangleSet object(outline_.vertices, object_.facets(object_.all_facets()));
    const std::size_t none = object_.count();
    std::vector<std::map<std::uint32_t, std::size_t>> votes(mesh_.count());
    for (std::size_t v = 0; v < mesh_.shell.vertices.size() && !progress_.cancelled(); ++v) {
      const auto near = object.nearest(mesh_.points.vertices[mesh_.shell.vertices[v]]);
      const std::uint32_t surface = mesh_.shell.component[mesh_.shell.star[mesh_.shell.star_begin[v]]];
      ++votes[surface][object_.shell.component[near.triangle]];
    }
    std::vector<std::size_t> taken(object_.count(), mesh_.count());
    of_mesh_.assign(mesh_.count(), none);
    for (std::uint32_t s = 0; s < mesh_.count(); ++s) {
      const auto most = std::max_element(votes[s].begin(), votes[s].end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      if (most == votes[s].end() || taken[most->first] != mesh_.count() ||
          mesh_.is_cavity(s) != object_.is_cavity(most->first)) {
        continue;
      }
      of_mesh_[s] = most->first;
      taken[most->first] = s;
    }
    bool is_one_to_one = true;
    for (std::uint32_t s = 0; s < mesh_.count(); ++s) {
      if (of_mesh_[s] == none) {
        is_one_to_one = false;
        findings_.add_undecided("surface.extra", "a surface of the mesh goes with none of the object's", mesh_.place(s),
                                false);
      } else if (mesh_.shell.euler[s] != object_.shell.euler[of_mesh_[s]]) {
        is_one_to_one = false;
        findings_.add_undecided("handles.component",
                                "a surface of the mesh has other handles than that which it goes with", mesh_.place(s),
                                false);
      }
    }
    for (std::uint32_t s = 0; s < object_.count(); ++s) {
      if (taken[s] != mesh_.count()) continue;
      is_one_to_one = false;
      findings_.add_undecided("surface.missing", "a surface of the object goes with none of the mesh's",
                              object_.place(s), false);
    }
    return is_one_to_one;
  }

  /// pairwise: between surfaces that go together, else between all of both.
  void measure(bool pairwise) {
    edge_mm_ = edges_of_mesh();
    std::vector<double> bounds(mesh_.shell.facets.size(), 0);
    if (!pairwise) {
      measure(mesh_.all_facets(), object_.all_facets(), bounds);
    } else {
      const auto ours = mesh_.facets_of_surfaces();
      const auto theirs = object_.facets_of_surfaces();
      for (std::size_t s = 0; s < ours.size() && !progress_.cancelled(); ++s) {
        measure(ours[s], theirs[of_mesh_[s]], bounds);
      }
    }
    for (std::size_t f = 0; f < bounds.size() && options_.lists_facets; ++f) {
      c_.bounds.push_back({mesh_.facet(f), bounds[f]});
    }
    for (const VerifiedDistance* d : {&c_.mesh_to_level, &c_.level_to_mesh}) {
      if (d->lower_mm <= longest_mm_) continue;
      findings_.add("surface.far", "the mesh's boundary and the surface are farther apart than the mesh's longest edge",
                    d->lower_place);
    }
  }

  void measure(const std::vector<std::uint32_t>& of_mesh, const std::vector<std::uint32_t>& of_object,
               std::vector<double>& bounds) {
    const TriangleSet ours(mesh_.points.vertices, mesh_.facets(of_mesh));
    const TriangleSet theirs(outline_.vertices, object_.facets(of_object));
    const auto take = [](const TriangleDistance& found, const TriangleSet& of, std::size_t t, VerifiedDistance& most) {
      if (found.lower_mm > most.lower_mm) {
        most.lower_mm = found.lower_mm;
        most.lower_place = found.lower_place;
      }
      if (most.upper_mm && found.upper_mm <= *most.upper_mm) return;
      most.upper_mm = found.upper_mm;
      most.upper_place = of.corners(t)[0];
    };
    const std::vector<TriangleDistance> from_mesh = surface_distances(ours, theirs, edge_mm_, progress_);
    for (std::size_t n = 0; n < of_mesh.size(); ++n) {
      bounds[of_mesh[n]] = from_mesh[n].upper_mm;
      take(from_mesh[n], ours, n, c_.mesh_to_level);
    }
    const std::vector<TriangleDistance> to_mesh = surface_distances(theirs, ours, edge_mm_, progress_);
    for (std::size_t t = 0; t < to_mesh.size(); ++t) take(to_mesh[t], theirs, t, c_.level_to_mesh);
  }

  /// The mean length of the boundary's edges; finds the longest, and the areas.
  double edges_of_mesh() {
    double sum = 0;
    for (const Triangle& facet : mesh_.facets(mesh_.all_facets())) {
      const auto corner = [&](std::size_t n) { return mesh_.points.vertices[facet[n % 3]]; };
      for (std::size_t n = 0; n < 3; ++n) {
        const double edge_mm = distance(corner(n), corner(n + 1));
        sum += edge_mm;
        longest_mm_ = std::max(longest_mm_, edge_mm);
      }
      c_.area_mm2 += 0.5 * length(cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    return sum / (3 * static_cast<double>(c_.facets));
  }

  void check_distance() {
    if (!options_.max_distance_mm) return;
    const std::string most = number_text(*options_.max_distance_mm, 4) + " mm";
    for (const VerifiedDistance* d : {&c_.mesh_to_level, &c_.level_to_mesh}) {
      const bool from_mesh = d == &c_.mesh_to_level;
      const std::string what = from_mesh ? "the mesh's boundary" : "the surface";
      const std::string other = from_mesh ? " of the surface" : " of the mesh's boundary";
      if (d->lower_mm > *options_.max_distance_mm) {
        findings_.add("distance.exceeded", what + " is not within " + most + other, d->lower_place);
      } else if (!d->upper_mm || *d->upper_mm > *options_.max_distance_mm) {
        findings_.add_undecided("distance.not_shown", what + " is not shown to be within " + most + other,
                                d->upper_place, false);
      }
    }
  }

  void grade(bool is_sound) {
    const auto has = [&](auto&& is) { return std::any_of(c_.findings.begin(), c_.findings.end(), is); };
    const bool is_wrong = has([](const VerifyFinding& f) { return f.is_wrong; });
    const bool is_open = has([](const VerifyFinding& f) { return !f.bounded; });
    c_.grade = is_wrong               ? CertificateGrade::not_the_scan
               : is_sound && !is_open ? CertificateGrade::bounded
                                      : CertificateGrade::undecided;
  }

  const VerifyOptions& options_;
  Progress& progress_;
  TetMesh outline_;  // the surface's vertices
  Boundary mesh_;
  Boundary object_;
  std::vector<VerifyFinding> of_object_;
  std::vector<std::size_t> of_mesh_;  // the object's surface that goes with each of the mesh's
  double edge_mm_ = 0;                // mean of the boundary's
  double longest_mm_ = 0;             // of these
  Certificate c_;
  FindingList findings_;
};

void check_surface(const TriangleSurface& surface) {
  const bool is_whole =
      !surface.facets.empty() && std::all_of(surface.facets.begin(), surface.facets.end(), [&](const Triangle& facet) {
        return *std::max_element(facet.begin(), facet.end()) < surface.vertices.size();
      });
  if (!is_whole) {
    throw Error(Fault::input, "input.surface", "the surface has no facets, or vertices that are not there",
                "give a closed surface of triangles");
  }
  const bool is_near = std::all_of(surface.vertices.begin(), surface.vertices.end(), [](const Point& p) {
    return std::abs(p.x) < 1e50 && std::abs(p.y) < 1e50 && std::abs(p.z) < 1e50;
  });
  if (!is_near) {
    throw Error(Fault::input, "input.range", "the surface has coordinates beyond 1e50 mm", "give it in mm");
  }
}

}  // namespace
}  // namespace verify

Certificate verify_surface(const TetMesh& mesh, const TriangleSurface& surface, const VerifyOptions& options,
                           Progress& progress) {
  verify::check_mesh(mesh);
  verify::check_surface(surface);
  const auto begin = std::chrono::steady_clock::now();
  Certificate certificate = verify::SurfaceVerification(mesh, surface, options, progress).run();
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return certificate;
}

}  // namespace scantet
