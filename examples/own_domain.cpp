// An object of one's own:   own_domain MESH
// Anything that answers two questions can be meshed: which region a point is in, and where a segment crosses from one
// region into another. Here it is a capsule, all points within 4 mm of a segment.
#include <scantet/scantet.h>

#include <algorithm>
#include <iostream>

namespace {

using scantet::Point;

class Capsule final : public scantet::Domain {
 public:
  // A little larger than the object: nothing of it may lie on the box.
  scantet::Box bounds() const override { return {{-15, -5, -5}, {15, 5, 5}}; }

  scantet::Region region_at(const Point& p) const override { return off_axis(p) < kRadius ? 1 : scantet::kOutside; }

  // The distance from the axis is a convex function along the segment: it falls, then rises. So there is one crossing
  // at most on each side of its lowest place. Both are found by asking region_at, so that the two queries cannot
  // disagree, and their order is that along the segment.
  void crossings(const scantet::Segment& segment, scantet::Crossings& out) const override {
    out.clear();
    const double lowest = lowest_place(segment);
    find_crossing(segment, 0, lowest, out);
    find_crossing(segment, lowest, 1, out);
  }

 private:
  static constexpr double kRadius = 4;
  static constexpr double kHalfLength = 10;

  static double off_axis(const Point& p) {
    return scantet::distance(p, {std::clamp(p.x, -kHalfLength, kHalfLength), 0, 0});
  }

  static Point at(const scantet::Segment& segment, double t) {
    return t == 1 ? segment.target : scantet::lerp(segment.source, segment.target, t);
  }

  static double lowest_place(const scantet::Segment& segment) {
    double begin = 0;
    double end = 1;
    for (int step = 0; step < 100; ++step) {
      const double first = begin + (end - begin) / 3;
      const double second = end - (end - begin) / 3;
      if (off_axis(at(segment, first)) < off_axis(at(segment, second))) {
        end = second;
      } else {
        begin = first;
      }
    }
    return 0.5 * (begin + end);
  }

  void find_crossing(const scantet::Segment& segment, double begin, double end, scantet::Crossings& out) const {
    const scantet::Region from = region_at(at(segment, begin));
    const scantet::Region to = region_at(at(segment, end));
    if (from == to) return;
    for (double t = 0.5 * (begin + end); begin < t && t < end; t = 0.5 * (begin + end)) {
      (region_at(at(segment, t)) == from ? begin : end) = t;
    }
    out.push_back({at(segment, end), from, to});
  }
};

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: own_domain MESH\n";
    return 2;
  }
  try {
    scantet::Progress progress;
    const Capsule capsule;
    const auto size = std::make_shared<scantet::UniformSize>(1.0);  // mm
    scantet::OptimizerOptions improvement;
    improvement.bounds.min_dihedral_deg = 15;
    const auto meshing = scantet::mesh_and_optimize(capsule, size, {}, improvement, progress);
    if (!meshing) return 130;  // cancelled
    const scantet::TetMesh& mesh = meshing->refined.mesh;

    scantet::AuditOptions how;
    how.restricted_delaunay = false;  // its points were moved to improve it
    const scantet::AuditReport found = scantet::audit(mesh, &capsule, how);
    for (const scantet::Finding& finding : found.findings) std::cout << "wrong: " << finding.message << '\n';
    const double volume_mm3 = scantet::measure_quality(mesh).total_volume_mm3;
    std::cout << mesh.tets.size() << " tets, " << volume_mm3 << " mm^3 of 1273.4\n";
    scantet::write_mesh(mesh, words[1]);
    return found.passed() && meshing->conformance.holds() && volume_mm3 > 1200 ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return static_cast<int>(error.fault());
  }
}
