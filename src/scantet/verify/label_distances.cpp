// Of a point p: if a point within d is surely in a region, and another within d surely not, then the boundary of the
// region is met on the line between them, within d of p. Faces of the mesh are cut into small parts, of which each is
// no farther from its centre than its longest side; the label map's cells are cut into boxes.
#include "scantet/verify/label_distances.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scantet/base/parallel.h"
#include "scantet/verify/cell_boxes.h"
#include "scantet/verify/distances.h"

namespace scantet::verify {
namespace {

/// How far a place is looked for, in voxels' smallest spacings.
constexpr std::array kSteps{0.0, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0};
constexpr double kAim = 0.2;  // spacings
constexpr int kDepth = 4;

void take(std::map<Region, ProvedDistance>& worst, Region region, std::optional<double> bound, const Point& place) {
  const auto [at, is_new] = worst.try_emplace(region, ProvedDistance{bound, place});
  ProvedDistance& most = at->second;
  if (is_new || !most.upper_mm || (bound && *bound <= *most.upper_mm)) return;
  most = {bound, place};
}

std::map<Region, ProvedDistance> join(const std::vector<std::map<Region, ProvedDistance>>& pieces) {
  std::map<Region, ProvedDistance> all;
  for (const auto& piece : pieces) {
    for (const auto& [region, d] : piece) take(all, region, d.upper_mm, d.place);
  }
  return all;
}

}  // namespace

/// The nearest places that are surely in each of two regions, and not in it.
struct LabelDistances::Sample {
  std::array<Region, 2> regions;
  std::array<double, 2> in{HUGE_VAL, HUGE_VAL};
  std::array<double, 2> out{HUGE_VAL, HUGE_VAL};
  double bound(std::size_t n) const { return std::max(in[n], out[n]); }
  bool is_done() const { return bound(0) < HUGE_VAL && bound(1) < HUGE_VAL; }
};

LabelDistances::LabelDistances(const TetMesh& mesh, const MeshRegions& regions, const LabelSource& labels)
    : mesh_(mesh),
      regions_(regions),
      labels_(labels),
      map_(labels.frame()),
      spacing_mm_(labels.frame().min_spacing_mm()) {
  std::map<Region, std::vector<std::uint32_t>> faces;
  for (std::uint32_t f = 0; f < regions.faces.size(); ++f) {
    for (const Region region : regions.faces[f].regions) faces[region].push_back(f);
  }
  for (auto& [region, list] : faces) {
    std::vector<Box> boxes(list.size());
    for (std::size_t n = 0; n < list.size(); ++n) {
      for (const VertexId v : regions.faces[list[n]].corners) boxes[n].extend(mesh.vertices[v]);
    }
    surfaces_.emplace(region, Surface{std::move(list), BoxTree(std::move(boxes))});
  }
  double largest = length(labels.frame().origin());
  for (int axis = 0; axis < 3; ++axis) {
    largest += (labels.size()[static_cast<std::size_t>(axis)] + 1) * length(labels.frame().column(axis));
  }
  for (const Point& p : mesh.vertices) largest = std::max(largest, length(p));
  margin_mm_ = 1e-12 * largest;
}

void LabelDistances::try_at(const Point& from, const Vec& along, double step, Sample& sample) const {
  const Point p = from + step * along;
  const std::optional<Region> region = sure_region(labels_, map_.to_index(p));
  if (!region) return;
  const double away = distance(p, from) * (1 + 1e-14) + margin_mm_;
  for (std::size_t n = 0; n < 2; ++n) {
    double& nearest = *region == sample.regions[n] ? sample.in[n] : sample.out[n];
    nearest = std::min(nearest, away);
  }
}

/// First along the normal of the face, then in steps to all sides.
void LabelDistances::try_ways(const Point& from, const Vec& across, Sample& sample) const {
  constexpr double kNear = 0.5;
  const auto both = [&](const Vec& way, double step) {
    try_at(from, way, step * spacing_mm_, sample);
    if (step > 0) try_at(from, way, -step * spacing_mm_, sample);
  };
  for (std::size_t n = 0; n < kSteps.size() && kSteps[n] <= kNear && !sample.is_done(); ++n) both(across, kSteps[n]);
  const std::array<Vec, 8> ways{across,
                                Vec{1, 0, 0},
                                Vec{0, 1, 0},
                                Vec{0, 0, 1},
                                Vec{0.6, 0.55, 0.58},
                                Vec{-0.58, 0.6, 0.55},
                                Vec{0.55, -0.58, 0.6},
                                Vec{0.58, 0.55, -0.6}};
  for (std::size_t n = 1; n < kSteps.size() && !sample.is_done(); ++n) {
    for (const Vec& way : ways) both(way, kSteps[n]);
  }
}

/// Voxels' centres are surely in their regions.
void LabelDistances::try_nodes(const Point& from, Sample& sample) const {
  constexpr int kReach = 3;
  const IntervalVec place = map_.to_index(from);
  std::array<int, 3> base{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double middle = std::round(place[axis].middle());
    if (!(middle > -2.0 - kReach && middle < labels_.size()[a] + 2.0 + kReach)) return;
    base[a] = static_cast<int>(middle);
  }
  for (int k = base[2] - kReach; k <= base[2] + kReach; ++k) {
    for (int j = base[1] - kReach; j <= base[1] + kReach; ++j) {
      for (int i = base[0] - kReach; i <= base[0] + kReach; ++i) {
        const IntervalVec node(Vec{double(i), double(j), double(k)});
        const double away = length_bound(map_.to_world(node - place));
        const Region region = labels_.region_of(i, j, k);
        for (std::size_t n = 0; n < 2; ++n) {
          double& nearest = region == sample.regions[n] ? sample.in[n] : sample.out[n];
          nearest = std::min(nearest, away);
        }
      }
    }
  }
}

std::array<std::optional<double>, 2> LabelDistances::bounds_of_face(const RegionFace& face) const {
  const std::array<Point, 3> p{mesh_.vertices[face.corners[0]], mesh_.vertices[face.corners[1]],
                               mesh_.vertices[face.corners[2]]};
  const double longest = std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
  const int parts = std::clamp(static_cast<int>(std::ceil(longest / (0.5 * spacing_mm_))), 1, 8);
  const double radius =
      longest / parts * (2.0 / 3 + 1e-9) + margin_mm_;  // no point of a part is farther from its centre
  const Vec normal = cross(p[1] - p[0], p[2] - p[0]);
  const double area = length(normal);
  const Vec across = area > 0 ? (1 / area) * normal : Vec{1, 0, 0};
  std::array<std::optional<double>, 2> worst{0.0, 0.0};
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; i + j < parts; ++j) {
      for (int turned = 0; turned < 2 && i + j + turned < parts; ++turned) {
        const double u = (i + (turned + 1) / 3.0) / parts;
        const double v = (j + (turned + 1) / 3.0) / parts;
        const Point center = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
        Sample sample{face.regions};
        try_ways(center, across, sample);
        if (!sample.is_done()) try_nodes(center, sample);
        for (std::size_t n = 0; n < 2; ++n) {
          if (sample.bound(n) == HUGE_VAL) {
            worst[n] = std::nullopt;
          } else if (worst[n]) {
            worst[n] = std::max(*worst[n], sample.bound(n) + radius);
          }
        }
      }
    }
  }
  return worst;
}

std::map<Region, ProvedDistance> LabelDistances::from_mesh(const Progress& progress) const {
  constexpr std::size_t kPiece = 64;
  const std::size_t count = regions_.faces.size();
  std::vector<std::map<Region, ProvedDistance>> pieces((count + kPiece - 1) / kPiece);
  parallel_for(count, kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end && !progress.cancelled(); ++f) {
      const RegionFace& face = regions_.faces[f];
      const auto bounds = bounds_of_face(face);
      for (std::size_t n = 0; n < 2; ++n) {
        take(pieces[begin / kPiece], face.regions[n], bounds[n], mesh_.vertices[face.corners[0]]);
      }
    }
  });
  return join(pieces);
}

double LabelDistances::distance_to(const Surface& surface, const Point& p, double enough) const {
  const double squared = surface.tree.nearest2(p, enough * enough, [&](std::uint32_t n) {
    const auto& corners = regions_.faces[surface.faces[n]].corners;
    return squared_distance_to(p, mesh_.vertices[corners[0]], mesh_.vertices[corners[1]], mesh_.vertices[corners[2]]);
  });
  return std::sqrt(squared) * (1 + 1e-12) + margin_mm_;
}

void LabelDistances::bound_box(const LabelCellValues& fields, const Cell& cell, const Box& box, int depth,
                               std::map<Region, ProvedDistance>& worst) const {
  const Candidates all = candidates(fields, cell, box);
  if (is_one(all)) return;
  const Point center = labels_.frame().to_world(box.center());
  const Vec half = 0.5 * box.extent();
  double radius = 0;
  for (int turn = 0; turn < 4; ++turn) {
    const Vec diagonal{half.x, turn & 1 ? -half.y : half.y, turn & 2 ? -half.z : half.z};
    radius = std::max(radius, length_bound(map_.to_world(IntervalVec(diagonal))));
  }
  bool is_small = true;
  std::array<std::optional<double>, 8> bounds;
  for (std::size_t n = 0; n < fields.count; ++n) {
    if ((all >> n & 1) == 0) continue;
    const auto surface = surfaces_.find(fields.regions[n]);
    const auto known = worst.find(fields.regions[n]);
    if (surface == surfaces_.end() || (known != worst.end() && !known->second.upper_mm)) continue;  // not bounded
    const double aim = std::max(kAim * spacing_mm_, known == worst.end() ? 0 : *known->second.upper_mm);
    bounds[n] = distance_to(surface->second, center, std::max(0.0, aim - radius - 2 * margin_mm_)) + radius;
    is_small = is_small && *bounds[n] <= aim;
  }
  if (!is_small && depth > 0) {
    for (int n = 0; n < 8; ++n) bound_box(fields, cell, eighth(box, n), depth - 1, worst);
    return;
  }
  for (std::size_t n = 0; n < fields.count; ++n) {
    if ((all >> n & 1) != 0) take(worst, fields.regions[n], bounds[n], center);
  }
}

std::map<Region, ProvedDistance> LabelDistances::from_field(const Progress& progress) const {
  std::vector<std::map<Region, ProvedDistance>> layers(static_cast<std::size_t>(labels_.size()[2]) + 1);
  for_cells(labels_, progress, [&](std::size_t layer, const Cell& cell) {
    if (only_region(labels_, cell)) return;
    LabelCellValues fields;
    labels_.cell(cell[0], cell[1], cell[2], fields);
    bound_box(fields, cell, whole_cell(cell), kDepth, layers[layer]);
  });
  return join(layers);
}

}  // namespace scantet::verify
