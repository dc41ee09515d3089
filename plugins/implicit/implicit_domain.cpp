// Outside of the box everything is outside, and the box's faces are proved to be, so that a segment may be cut down to
// the box: what it crosses, it crosses there. A shell of 1e-9 of the box beneath the faces is proved with them, which
// leaves room for the rounding of the cut.
#include "implicit_domain.h"

#include "crossing_search.h"
#include "scantet/base/box_clip.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"

namespace implicit {
namespace {

using scantet::Box;
using scantet::Error;
using scantet::Fault;
using scantet::number_text;
using scantet::Point;
using scantet::Segment;

constexpr int kSamples = 33;  // each way: a power of two and one, so that the middle is among them
constexpr int kMostPatches = 200'000;
constexpr double kShell = 1e-9;

std::string text_of(const Point& p) {
  return "(" + number_text(p.x, 6) + ", " + number_text(p.y, 6) + ", " + number_text(p.z, 6) + ")";
}

/// The part of the segment in the box, if any, its ends not beside a wall of the box by rounding.
std::optional<Segment> part_in_box(const Segment& segment, const Box& box) {
  std::optional<Segment> part = clipped(segment, box);
  if (!part) return part;
  for (Point* const end : {&part->source, &part->target}) {
    for (int axis = 0; axis < 3; ++axis) (*end)[axis] = std::clamp((*end)[axis], box.min[axis], box.max[axis]);
  }
  return part;
}

/// Proves the formula positive in boxes, by halving them until its interval is.
class Prover {
 public:
  Prover(const Formula& formula, const Box& box, const scantet::Progress& progress)
      : formula_(formula), box_(box), progress_(progress) {}

  void prove_face(int axis, bool upper) {
    Box shell = box_;
    const double inner = kShell * box_.extent()[axis];
    (upper ? shell.min : shell.max)[axis] = upper ? box_.max[axis] - inner : box_.min[axis] + inner;
    face_ = std::string("the face ") + "xyz"[axis] + " = " + number_text(upper ? box_.max[axis] : box_.min[axis], 6) +
            " mm of the box";
    left_ = kMostPatches;
    prove(shell);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(Fault::input, "input.bounds", what, "enlarge --bounds, or make the formula positive there");
  }

  void prove(const Box& patch) {
    if (progress_.cancelled()) return;
    const auto range = [&](int axis) { return Interval{patch.min[axis], patch.max[axis]}; };
    if (formula_(range(0), range(1), range(2)).lo > 0) return;
    const Point p = patch.center();
    if (!(formula_(p.x, p.y, p.z) > 0)) refuse("the object meets " + face_ + " at " + text_of(p));
    const scantet::Vec extent = patch.extent();
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (extent[axis] > extent[longest]) longest = axis;
    }
    const bool has_halves = patch.min[longest] < p[longest] && p[longest] < patch.max[longest];
    if (--left_ < 0 || !has_halves) {
      refuse("the object comes so near to " + face_ + " that it cannot be shown to stay inside, near " + text_of(p));
    }
    Box lower = patch;
    Box upper = patch;
    lower.max[longest] = upper.min[longest] = p[longest];
    prove(lower);
    prove(upper);
  }

  const Formula& formula_;
  const Box& box_;
  const scantet::Progress& progress_;
  std::string face_;
  int left_ = 0;
};

}  // namespace

ImplicitDomain::ImplicitDomain(Formula formula, const Box& box, const scantet::Progress& progress)
    : formula_(std::move(formula)), box_(box) {
  sample(progress);
  prove_closed(progress);
  if (progress.cancelled()) return;
  if (sampled_.lo >= 0) {
    throw Error(Fault::input, "input.empty",
                "the formula is negative at none of 33 x 33 x 33 points of the box; the least value is " +
                    number_text(sampled_.lo, 6),
                "fit --bounds to the object; inside is where the formula is negative");
  }
  grid_ = FormulaGrid(formula_, box_, progress);
}

void ImplicitDomain::sample(const scantet::Progress& progress) {
  sampled_ = {kInfinity, -kInfinity};
  const auto at = [&](int axis, int i) { return box_.min[axis] + box_.extent()[axis] * i / (kSamples - 1); };
  for (int k = 0; k < kSamples; ++k) {
    for (int j = 0; j < kSamples && !progress.cancelled(); ++j) {
      for (int i = 0; i < kSamples; ++i) {
        const Point p{at(0, i), at(1, j), at(2, k)};
        const double value = formula_(p.x, p.y, p.z);
        if (!std::isfinite(value)) {
          throw Error(Fault::input, "input.formula",
                      "the formula is " + number_text(value) + " at " + text_of(p) + " mm",
                      "change the formula or --bounds so that it is finite in the whole box");
        }
        sampled_ = hull(sampled_, {value, value});
      }
    }
  }
}

void ImplicitDomain::prove_closed(const scantet::Progress& progress) const {
  Prover prover(formula_, box_, progress);
  for (int axis = 0; axis < 3; ++axis) {
    prover.prove_face(axis, false);
    prover.prove_face(axis, true);
  }
}

scantet::Region ImplicitDomain::region_at(const Point& p) const {
  if (!box_.contains(p)) return scantet::kOutside;
  const scantet::ClearanceGrid::Place place = grid_.clear().at(p);
  if (place.state != scantet::CubeState::near) return place.state == scantet::CubeState::inside ? 1 : scantet::kOutside;
  const Interval values = grid_.model(grid_.clear().grid().index(place.cube)).values_at(p);
  const double value = values.lo > 0 || values.hi < 0 ? values.lo : formula_(p.x, p.y, p.z);
  return value < 0 ? 1 : scantet::kOutside;
}

void ImplicitDomain::crossings(const Segment& segment, scantet::Crossings& out) const {
  const std::optional<Segment> within = part_in_box(segment, box_);
  if (within) {
    find_crossings(formula_, grid_, *within, out);
  } else {
    out.clear();
  }
}

std::optional<double> ImplicitDomain::residual_at(const Point& p) const {
  return std::abs(formula_(p.x, p.y, p.z)) / (sampled_.hi - sampled_.lo);
}

}  // namespace implicit
