// While the weight of v grows and all others stay, the weighted Delaunay triangulation changes at v alone: its star
// swallows the tets around it, in the order of the weights at which v enters their orthospheres (the spheres orthogonal
// to the weighted points of their vertices), and the faces that it then ends with are joined to v. Whether that makes
// tets is left to their orientation: positive ones with the same outer faces fill the same place. A step that leaves an
// inverted tet is passed over, for the next one may swallow what is in the way, unless that is the boundary. The star
// never grows through the boundary, so it keeps v's boundary facets, which hang on the rim of the link.
#include <algorithm>

#include "scantet/optimize/star_pump_impl.h"

namespace scantet::optimize {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int corner_of(const Tet& tet, VertexId v) {
  return static_cast<int>(std::find(tet.begin(), tet.end(), v) - tet.begin());
}

}  // namespace

void StarPump::try_vertex(VertexId v, TetId t, Change& best) {
  vertex_ = v;
  start(t);
  look_beyond(link_[0]);
  if (!(link_[0].critical < limit_)) return;
  for (std::size_t i = 1; i < link_.size(); ++i) look_beyond(link_[i]);

  double weight = this->weight(v);
  int chosen = 0;
  for (int step = 1;; ++step) {
    const LinkFace* next = next_face();
    const bool grows = next->critical < limit_;
    const double next_weight = std::max(weight, grows ? next->critical : limit_);
    if (chosen != 0 && chosen == step - 1) best.weight_mm2 = 0.5 * (weight + next_weight);
    if (!grows || (chosen != 0 && best.sharpest <= bound_)) break;
    weight = next_weight;
    if (!swallow(next->outer, step, best.sharpest)) break;
    if (link_[0].died == kNever) continue;
    const double sharpest = std::max(sharpest_added(), bound_);
    if (sharpest < best.sharpest) {
      best.sharpest = sharpest;
      best.weight_mm2 = weight;
      chosen = step;
    }
  }
  if (chosen != 0) record(chosen, best);
}

/// A tet goes when the star of one of its vertices grows over the face opposite to it, or when a star grows over the
/// tet itself.
void StarPump::try_tet(TetId t, Change& best) {
  const Tet& tet = complex_.tet(t);
  for (const VertexId v : tet) {
    try_vertex(v, t, best);
    if (best.sharpest <= bound_) return;
  }
  for (int k = 0; k < 4; ++k) {
    const TetId beyond = complex_.across(t, k);
    if (beyond == kNoTet || complex_.region(beyond) != complex_.region(t)) continue;
    for (const VertexId v : complex_.tet(beyond)) {
      if (!has_vertex(tet, v)) try_vertex(v, beyond, best);
    }
    if (best.sharpest <= bound_) return;
  }
}

/// Begins with the star of v as the complex has it; the face of t comes first.
void StarPump::start(TetId t) {
  link_.clear();
  swallowed_.clear();
  limit_ = kInfinity;
  for (const TetId inner : complex_.star(vertex_)) {
    const Tet& tet = complex_.tet(inner);
    for (const VertexId u : tet) {
      if (u == vertex_) continue;
      limit_ = std::min(limit_, squared_distance(complex_.point(u), complex_.point(vertex_)) + weight(u));
    }
    link_.push_back({tet, inner, kNoTet, 0, kNever, kInfinity, 0});
    if (inner == t) std::swap(link_.front(), link_.back());
  }
}

void StarPump::look_beyond(LinkFace& face) const {
  const TetId outer = complex_.across(face.inner, corner_of(face.tet, vertex_));
  if (outer == kNoTet || complex_.region(outer) != complex_.region(face.inner)) return;
  face.outer = outer;
  const double critical = critical_weight(outer);
  if (critical < face.critical) face.critical = critical;  // else NaN: where `outer` is flat and v in its plane
}

/// The power of v with respect to the orthosphere of t. Seen from v, the squared distance less the weight is an affine
/// function on the vertices of t, and its value at v itself is what is asked for, but for the sign.
double StarPump::critical_weight(TetId t) const {
  const Point& origin = complex_.point(vertex_);
  const Tet& tet = complex_.tet(t);
  std::array<Vec, 4> x;
  std::array<double, 4> height{};
  for (std::size_t i = 0; i < 4; ++i) {
    x[i] = complex_.point(tet[i]) - origin;
    height[i] = squared_length(x[i]) - weight(tet[i]);
  }
  const Vec x01 = cross(x[0], x[1]);
  const Vec x23 = cross(x[2], x[3]);
  // v in barycentric coordinates, times the volume.
  const std::array<double, 4> share{dot(x[1], x23), -dot(x[0], x23), dot(x[3], x01), -dot(x[2], x01)};
  return -(share[0] * height[0] + share[1] * height[1] + share[2] * height[2] + share[3] * height[3]) /
         (share[0] + share[1] + share[2] + share[3]);
}

const StarPump::LinkFace* StarPump::next_face() const {
  const LinkFace* next = nullptr;
  for (const LinkFace& face : link_) {
    if (face.died == kNever && (next == nullptr || face.critical < next->critical)) next = &face;
  }
  return next;
}

/// Returns false where it is of no use to go on: a tet is added for good that is as sharp as `too_sharp`, or a vertex
/// would lose its last tet.
bool StarPump::swallow(TetId t, int step, double too_sharp) {
  const Tet tet = complex_.tet(t);
  swallowed_.push_back(t);
  std::array<bool, 4> shared{};  // with the star, by the corner opposite
  for (LinkFace& face : link_) {
    if (face.died != kNever || face.outer != t) continue;
    face.died = step;
    for (std::size_t i = 0; i < 4; ++i) {
      if (corner_of(face.tet, tet[i]) == 4) shared[i] = true;
    }
  }
  if (std::count(shared.begin(), shared.end(), true) > 2) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    if (shared[i]) continue;
    LinkFace face{tet, t, kNoTet, step, kNever, kInfinity, 0};
    face.tet[i] = vertex_;
    face.sharpness = complex_.sharpness(face.tet, too_sharp);
    look_beyond(face);
    if (face.sharpness >= too_sharp && !(face.critical < limit_)) return false;
    link_.push_back(face);
  }
  return true;
}

double StarPump::sharpest_added() const {
  double sharpest = -kInverted;
  for (const LinkFace& face : link_) {
    if (face.born > 0 && face.died == kNever) sharpest = std::max(sharpest, face.sharpness);
  }
  return sharpest;
}

void StarPump::record(int step, Change& change) const {
  change.vertex = kNoVertex;
  change.weighted = weights_.empty() ? kNoVertex : vertex_;
  change.removed.assign(swallowed_.begin(), swallowed_.begin() + step);
  change.added.clear();
  change.read.clear();
  for (const LinkFace& face : link_) {
    if (face.outer != kNoTet) change.read.push_back(face.outer);
    if (face.born == 0) {
      change.read.push_back(face.inner);
      if (face.died <= step) change.removed.push_back(face.inner);
    } else if (face.born <= step && face.died > step) {
      change.added.push_back({face.tet, complex_.region(face.inner)});
    }
  }
}

}  // namespace scantet::optimize
