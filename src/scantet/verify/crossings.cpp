#include "scantet/verify/crossings.h"

#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/verify/exact_sign.h"
#include "scantet/verify/findings.h"
#include "scantet/verify/prism.h"

namespace scantet::verify {
namespace {

enum class Contact { apart, cross, unknown };

using Corners = std::array<Point, 3>;

/// A segment against a triangle with which it shares no vertex: whether they have a point in common.
Contact meet_segment(const Point& p, const Point& q, const Corners& t) {
  const int side_p = orientation(t[0], t[1], t[2], p);
  const int side_q = orientation(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return Contact::apart;
  if (side_p == 0 && side_q == 0) return Contact::unknown;  // in one plane
  int least = 1;
  int most = -1;
  for (std::size_t n = 0; n < 3; ++n) {
    const int turn = orientation(p, q, t[n], t[(n + 1) % 3]);
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  return least < 0 && most > 0 ? Contact::apart : Contact::cross;
}

Contact worse(Contact a, Contact b) {
  if (a == Contact::cross || b == Contact::cross) return Contact::cross;
  return a == Contact::unknown || b == Contact::unknown ? Contact::unknown : Contact::apart;
}

/// Whether a plane through a vertex is proved to part two triangles that have it: their other corners are strictly on
/// different sides. For triangles in one plane; the planes tried stand on it, halfway between their sides.
bool are_parted(const Point& vertex, const std::array<Point, 2>& a, const std::array<Point, 2>& b) {
  const auto unit = [&](const Point& p) {
    const Vec d = p - vertex;
    return (1 / length(d)) * d;
  };
  const auto parts = [&](const Vec& n) {
    const IntervalVec direction(n);
    const auto side = [&](const Point& p) { return dot(direction, IntervalVec(p) - IntervalVec(vertex)); };
    const bool up = side(a[0]).is_positive() && side(a[1]).is_positive();
    const bool down = side(a[0]).is_negative() && side(a[1]).is_negative();
    return (up && side(b[0]).is_negative() && side(b[1]).is_negative()) ||
           (down && side(b[0]).is_positive() && side(b[1]).is_positive());
  };
  if (parts(unit(a[0]) + unit(a[1]) - unit(b[0]) - unit(b[1]))) return true;
  const Vec normal = cross(unit(a[0]), unit(a[1]));
  for (const Point& p : a) {
    for (const Point& q : b) {
      if (parts(cross(normal, unit(p) + unit(q))) || parts(unit(p) + unit(q))) return true;
    }
  }
  return false;
}

class Pairs {
 public:
  Pairs(const TetMesh& mesh, const Shell& shell) : mesh_(mesh), shell_(shell) {}

  Contact contact(std::size_t f, std::size_t g) const {
    const Triangle& s = shell_.facets[f];
    const Triangle& t = shell_.facets[g];
    std::vector<std::size_t> shared;
    for (std::size_t n = 0; n < 3; ++n) {
      if (std::find(t.begin(), t.end(), s[n]) != t.end()) shared.push_back(n);
    }
    if (shared.empty()) return apart_or(f, g, [&] { return all_sides(f, g); });
    if (shared.size() == 1) {
      const auto other = static_cast<std::size_t>(std::find(t.begin(), t.end(), s[shared[0]]) - t.begin());
      const std::array<Point, 2> a{at(f, shared[0] + 1), at(f, shared[0] + 2)};
      const std::array<Point, 2> b{at(g, other + 1), at(g, other + 2)};
      const Contact found = worse(meet_segment(a[0], a[1], corners(g)), meet_segment(b[0], b[1], corners(f)));
      return found == Contact::unknown && are_parted(at(f, shared[0]), a, b) ? Contact::apart : found;
    }
    if (shared.size() == 3) return Contact::cross;
    const std::size_t apex = 3 - shared[0] - shared[1];
    const VertexId v = s[shared[0]];
    const VertexId w = s[shared[1]];
    const auto other = static_cast<std::size_t>(
        std::find_if(t.begin(), t.end(), [&](VertexId x) { return x != v && x != w; }) - t.begin());
    const Point a = at(f, shared[0]);
    const Point b = at(f, shared[1]);
    if (orientation(a, b, at(f, apex), at(g, other)) != 0) return Contact::apart;
    const auto normal = [&](const Point& p) {
      return cross(IntervalVec(b) - IntervalVec(a), IntervalVec(p) - IntervalVec(a));
    };
    const Interval turned = dot(normal(at(f, apex)), normal(at(g, other)));
    return turned.is_negative() ? Contact::apart : turned.is_positive() ? Contact::cross : Contact::unknown;
  }

 private:
  Point at(std::size_t f, std::size_t n) const { return mesh_.vertices[shell_.vertices[shell_.facets[f][n % 3]]]; }
  Corners corners(std::size_t f) const { return {at(f, 0), at(f, 1), at(f, 2)}; }

  template <class Otherwise>
  Contact apart_or(std::size_t f, std::size_t g, const Otherwise& otherwise) const {
    const Contact found = otherwise();
    if (found != Contact::unknown) return found;
    const auto flat = [&](std::size_t facet) {
      Prism prism;
      for (std::size_t n = 0; n < 3; ++n) prism.p[n] = IntervalVec(at(facet, n));
      return prism;
    };
    return stay_apart(flat(f), flat(g)) ? Contact::apart : Contact::unknown;
  }

  Contact all_sides(std::size_t f, std::size_t g) const {
    Contact all = Contact::apart;
    for (std::size_t n = 0; n < 3; ++n) {
      all = worse(all, meet_segment(at(f, n), at(f, n + 1), corners(g)));
      all = worse(all, meet_segment(at(g, n), at(g, n + 1), corners(f)));
    }
    return all;
  }

  const TetMesh& mesh_;
  const Shell& shell_;
};

}  // namespace

bool check_crossings(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays,
                     const std::vector<std::uint8_t>& faults, std::vector<VerifyFinding>& list,
                     const Progress& progress) {
  struct Bad {
    std::uint32_t facet;
    Contact contact;
  };
  const std::size_t count = shell.facets.size();
  const BoxTree& tree = rays.tree();
  const Pairs pairs(mesh, shell);
  const auto bad = parallel_collect<Bad>(count, 128, [&](std::size_t begin, std::size_t end, std::vector<Bad>& out) {
    for (std::size_t f = begin; f < end && !progress.cancelled(); ++f) {
      if (faults[f] == 0) continue;
      tree.visit_meeting(tree.box(f), [&](std::uint32_t g) {
        if (g == f || (faults[g] != 0 && g < f)) return;
        const Contact contact = pairs.contact(f, g);
        if (contact != Contact::apart) out.push_back({static_cast<std::uint32_t>(f), contact});
      });
    }
  });
  FindingList findings(list);
  for (const Bad& b : bad) {
    const Point place = mesh.vertices[shell.vertices[shell.facets[b.facet][0]]];
    if (b.contact == Contact::cross) {
      findings.add("boundary.crossing", "two facets of the boundary cross or touch", place);
    } else {
      findings.add_undecided("boundary.contact", "whether two facets of the boundary touch could not be decided", place,
                             false);
    }
  }
  return bad.empty();
}

}  // namespace scantet::verify
