// Opens *.ellipsoid: a text file with the three semi-axes of an ellipsoid around the origin, in mm.
#include <algorithm>
#include <fstream>

#include "scantet/base/error.h"
#include "scantet/plugin/plugin.h"

namespace {

using namespace scantet;

class Ellipsoid final : public Domain {
 public:
  explicit Ellipsoid(const Vec& semi_axes_mm) : semi_axes_(semi_axes_mm) {}

  // A little larger than the object: nothing of it may lie on the box.
  Box bounds() const override { return {-1.01 * semi_axes_, 1.01 * semi_axes_}; }

  Region region_at(const Point& p) const override { return squared_length(in_ball(p)) < 1 ? 1 : kOutside; }

  // Convex: the segment is inside between at most two crossings, and if anywhere, then at its point nearest to the
  // centre of the ball. Bisection asks region_at, so that the two queries cannot disagree.
  void crossings(const Segment& segment, Crossings& out) const override {
    out.clear();
    const Vec from = in_ball(segment.source);
    const Vec along = in_ball(segment.target) - from;
    const double middle = along == Vec{} ? 0 : std::clamp(-dot(from, along) / squared_length(along), 0.0, 1.0);
    find_crossing(segment, 0, middle, out);
    find_crossing(segment, middle, 1, out);
  }

 private:
  Vec in_ball(const Point& p) const { return {p.x / semi_axes_.x, p.y / semi_axes_.y, p.z / semi_axes_.z}; }

  Point at(const Segment& segment, double t) const {
    return t == 1 ? segment.target : lerp(segment.source, segment.target, t);
  }

  void find_crossing(const Segment& segment, double begin, double end, Crossings& out) const {
    const Region from = region_at(at(segment, begin));
    const Region to = region_at(at(segment, end));
    if (from == to) return;
    for (double t = 0.5 * (begin + end); begin < t && t < end; t = 0.5 * (begin + end)) {
      (region_at(at(segment, t)) == from ? begin : end) = t;
    }
    out.push_back({at(segment, end), from, to});
  }

  Vec semi_axes_;
};

class EllipsoidPlugin final : public InputPlugin {
 public:
  std::string name() const override { return "ellipsoid"; }
  std::string description() const override { return "*.ellipsoid, a text file with three semi-axes in mm"; }
  int can_open(const std::string& input) const override { return input.ends_with(".ellipsoid") ? 100 : 0; }
  void declare_options(OptionSet& options) override {
    options.add("scale", scale_, Range::above(0), {"Ellipsoid", "X", "a factor", "Multiplies the semi-axes."});
  }
  OpenedDomain open(const std::string& input, Progress&) override {
    const Vec semi_axes = read(input);
    OpenedDomain opened;
    opened.domain = std::make_unique<Ellipsoid>(semi_axes);
    opened.default_size_mm = std::min({semi_axes.x, semi_axes.y, semi_axes.z}) / 4;
    opened.default_size_reason = "a quarter of the shortest semi-axis";
    opened.files = {input};
    return opened;
  }
  std::vector<InfoSection> info(const std::string& input, Progress&) override {
    const Vec a = read(input);
    const std::vector<double> semi_axes{a.x, a.y, a.z};
    return {{"ellipsoid", "Ellipsoid", {{"semi_axes_mm", "semi-axes", semi_axes, "mm"}}}};
  }

 private:
  Vec read(const std::string& input) const {
    std::ifstream file(input);
    Vec a;
    if (!(file >> a.x >> a.y >> a.z) || !(a.x > 0 && a.y > 0 && a.z > 0)) {
      throw Error(Fault::input, "input.ellipsoid", input + ": not three semi-axes greater than 0",
                  "write three numbers, e.g. 8 5 3");
    }
    return scale_ * a;
  }

  double scale_ = 1;
};

}  // namespace

SCANTET_PLUGIN(EllipsoidPlugin);
