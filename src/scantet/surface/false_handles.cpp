// The disk is the fan of triangles from the mean of the path's vertices to its edges, known by points on its spokes.
#include <algorithm>
#include <array>

#include "scantet/base/handle_loops.h"
#include "scantet/delaunay/inserter_impl.h"
#include "scantet/surface/false_handles_impl.h"

namespace scantet::engine {
namespace {

constexpr double kLongest = 2;                                  // sizes
constexpr std::array<double, 3> kAlongSpokes{0.25, 0.5, 0.75};  // of the way from the centre
constexpr double kOnOneSide = 0.9;                              // of the points, in the mesh
constexpr double kElsewhere = 0.25;                             // of the points, on the other side in the domain

/// The points of one disk.
class DiskSides {
 public:
  DiskSides(const std::vector<Point>& vertices, Region first, Triangulation& t, const Domain& domain)
      : vertices_(vertices), first_(first), t_(t), domain_(domain) {}

  /// Looks at the disk of a path.
  void look(const HandleLoop& loop) {
    points_.assign(1, loop.center);
    for (const double share : kAlongSpokes) {
      for (const VertexId v : loop.vertices) points_.push_back(lerp(loop.center, vertices_[v], share));
    }
    regions_.resize(points_.size());
    domain_.regions_at(points_, regions_);
    Inserter inserter(t_);
    std::vector<CellId> star;
    t_.star_of(loop.vertices.front(), star);
    CellId at = star.front();
    cells_.clear();
    for (const Point& p : points_) cells_.push_back(at = inserter.cell_at(p, at));
  }

  bool is_false() const {
    std::size_t inside = 0;
    std::size_t elsewhere = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      inside += is_inside(i) ? 1 : 0;
      elsewhere += is_elsewhere(i) ? 1 : 0;
    }
    const auto count = static_cast<double>(points_.size());
    const auto most = static_cast<double>(std::max(inside, points_.size() - inside));
    return most >= kOnOneSide * count && static_cast<double>(elsewhere) >= kElsewhere * count;
  }

  /// One in each tet.
  void add_places(std::uint32_t group, std::vector<Misplaced>& places) const {
    std::vector<CellId> done;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!is_elsewhere(i) || std::find(done.begin(), done.end(), cells_[i]) != done.end()) continue;
      done.push_back(cells_[i]);
      places.push_back({points_[i], regions_[i], group});
    }
  }

 private:
  bool is_inside(std::size_t i) const { return t_.info(cells_[i]).region >= first_; }
  bool is_elsewhere(std::size_t i) const { return is_inside(i) != (regions_[i] >= first_); }

  const std::vector<Point>& vertices_;
  Region first_;
  Triangulation& t_;
  const Domain& domain_;
  std::vector<Point> points_;
  std::vector<Region> regions_;
  std::vector<CellId> cells_;
};

}  // namespace

std::vector<Misplaced> false_handles(const TriangleSurface& boundary, Region first, Triangulation& t,
                                     const Domain& domain, const SizingField& size) {
  const auto is_false = [&](const HandleLoop& loop) {
    DiskSides disk(boundary.vertices, first, t, domain);
    disk.look(loop);
    return disk.is_false();
  };
  const auto longest_mm = [&](const Point& p) { return kLongest * size.size_at(p); };
  std::vector<Misplaced> places;
  std::uint32_t group = 0;
  DiskSides disk(boundary.vertices, first, t, domain);
  for (const HandleLoop& loop : handle_loops(boundary, longest_mm, is_false)) {
    disk.look(loop);
    disk.add_places(group++, places);
  }
  return places;
}

}  // namespace scantet::engine
