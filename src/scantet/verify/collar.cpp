#include "scantet/verify/collar.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "scantet/base/parallel.h"
#include "scantet/verify/box_tree.h"

namespace scantet::verify {
namespace {

constexpr int kBoxesOfSlope = 400;  // how many pieces of a facet's collar are looked at
constexpr int kBoxesOfValue = 300;

/// The places of a facet's samples, three weights each; those that tend to be farthest from the level set come first.
constexpr std::array<std::array<double, 3>, 10> kSamples{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                          {0.6, 0.2, 0.2},
                                                          {0.2, 0.6, 0.2},
                                                          {0.2, 0.2, 0.6},
                                                          {0.5, 0.5, 0},
                                                          {0, 0.5, 0.5},
                                                          {0.5, 0, 0.5},
                                                          {1, 0, 0},
                                                          {0, 1, 0},
                                                          {0, 0, 1}}};

Point world(const CollarInput& in, std::uint32_t v) {
  return in.mesh.vertices[in.shell.vertices[v]];
}

/// A direction that looks into the mesh from all facets around a vertex, as far as a few steps find one; world.
Vec inner_direction(const CollarInput& in, std::uint32_t v) {
  std::vector<Vec> normals;
  Vec sum;
  for (std::uint32_t n = in.shell.star_begin[v]; n < in.shell.star_begin[v + 1]; ++n) {
    const Triangle& t = in.shell.facets[in.shell.star[n]];
    const auto at = static_cast<std::size_t>(std::find(t.begin(), t.end(), v) - t.begin());
    const Vec a = world(in, t[(at + 1) % 3]) - world(in, v);
    const Vec b = world(in, t[(at + 2) % 3]) - world(in, v);
    const Vec normal = cross(b, a);
    const double size = length(normal);
    if (!(size > 0)) continue;
    normals.push_back((1 / size) * normal);
    sum = sum + std::atan2(size, dot(a, b)) * normals.back();
  }
  for (int step = 0; step < 30; ++step) {
    const double size = length(sum);
    if (!(size > 0)) return {};
    sum = (1 / size) * sum;
    const Vec* worst = nullptr;
    double least = 0.5;
    for (const Vec& normal : normals) {
      if (dot(sum, normal) >= least) continue;
      least = dot(sum, normal);
      worst = &normal;
    }
    if (worst == nullptr) break;
    sum = sum + (0.6 - least) * *worst;
  }
  return (1 / length(sum)) * sum;
}

/// Where the level set is on a line from `place` along `along` (1 mm), mm, to rounding; the limit if not nearer. If it
/// is crossed before `known`, that.
double sampled_distance(const VoxelNodes& nodes, const Vec& place, const Vec& along, double known, double limit) {
  const double here = sampled_value(nodes, place);
  const double way = here > 0 ? -1 : 1;
  if (known > 0 && (sampled_value(nodes, place + way * known * along) > 0) != (here > 0)) return known;
  double before = 0;
  for (int step = 1; step <= 16; ++step) {
    const double to = limit * step * step / 256;
    if ((sampled_value(nodes, place + way * to * along) > 0) == (here > 0)) {
      before = to;
      continue;
    }
    double low = before;
    double high = to;
    for (int halving = 0; halving < 12; ++halving) {
      const double middle = 0.5 * (low + high);
      ((sampled_value(nodes, place + way * middle * along) > 0) == (here > 0) ? low : high) = middle;
    }
    return high;
  }
  return limit;
}

bool winds_once(const CollarInput& in, const Collar& collar, std::uint32_t v) {
  if (!in.shell.is_disc[v]) return false;
  std::vector<IntervalVec> link;
  for (std::uint32_t n = in.shell.star_begin[v]; n < in.shell.star_begin[v + 1]; ++n) {
    const Triangle t = in.shell.facets[in.shell.star[n]];
    const auto at = static_cast<std::size_t>(std::find(t.begin(), t.end(), v) - t.begin());
    link.push_back(in.places[t[(at + 1) % 3]] - in.places[v]);
  }
  if (in.map.handedness() > 0) std::reverse(link.begin(), link.end());  // as seen from within
  const IntervalVec fibre(collar.directions[v]);
  const auto turn = [&](const IntervalVec& a, const IntervalVec& b) { return det(a, b, fibre); };
  const std::size_t count = link.size();
  const IntervalVec first = link[0] + link[1 % count];
  for (std::size_t n = 0; n < count; ++n) {
    const IntervalVec& a = link[n];
    const IntervalVec& b = link[(n + 1) % count];
    if (!turn(a, b).is_positive()) return false;
    if (n > 0 && !turn(a, first).is_negative() && !turn(first, b).is_negative()) return false;
  }
  return true;
}

class Search {
 public:
  Search(const CollarInput& input, Progress& progress) : in_(input), progress_(progress) {
    const std::size_t vertices = in_.shell.vertices.size();
    collar_.directions.resize(vertices);
    collar_.heights.assign(vertices, 0);
    collar_.faults.assign(in_.shell.facets.size(), 0);
    collar_.bound_mm.assign(in_.shell.facets.size(), 0);
    voxel_ = in_.nodes.frame().min_spacing_mm();
    aim();
    guess();
  }

  Collar run(int rounds) {
    std::vector<std::uint8_t> is_due(in_.shell.facets.size(), 1);
    Collar best;
    std::size_t fewest = in_.shell.facets.size() + 1;
    for (int round = 0; round <= rounds; ++round) {
      test(is_due, round);
      if (progress_.cancelled()) break;
      const auto bad = static_cast<std::size_t>(
          std::count_if(collar_.faults.begin(), collar_.faults.end(), [](std::uint8_t f) { return f != 0; }));
      if (bad < fewest) {
        fewest = bad;
        best = collar_;
      }
      if (bad == 0 || round == rounds) break;
      if (round == (rounds + 1) / 2) turn();
      change(is_due, 1.8 - 0.8 * round / (rounds + 1));
    }
    return best;
  }

 private:
  void aim() {
    winds_.assign(collar_.directions.size(), 0);
    parallel_for(collar_.directions.size(), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto vertex = static_cast<std::uint32_t>(v);
        collar_.directions[v] = in_.map.index_direction(inner_direction(in_, vertex));
        winds_[v] = winds_once(in_, collar_, vertex);
      }
    });
  }

  /// Where facets fail, fibres turn to where the field grows fastest, as long as their stars still wind once.
  void turn() {
    for (std::uint32_t v = 0; v < collar_.directions.size(); ++v) {
      bool fails = false;
      for (std::uint32_t n = in_.shell.star_begin[v]; n < in_.shell.star_begin[v + 1]; ++n) {
        fails = fails || (collar_.faults[in_.shell.star[n]] & (kSlope | kFold | kVertex)) != 0;
      }
      if (!fails) continue;
      const Vec steepest = sampled_ascent(v);
      if (!(length(steepest) > 0)) continue;
      const Vec old = collar_.directions[v];
      collar_.directions[v] = 0.4 * old + 0.6 * in_.map.index_direction(steepest);
      const bool winds = winds_once(in_, collar_, v);
      if (winds || !winds_[v]) {
        winds_[v] = winds;
        turned_.push_back(v);
      } else {
        collar_.directions[v] = old;
      }
    }
  }

  /// Where the field grows fastest around a vertex, world, of length 1; to rounding.
  Vec sampled_ascent(std::uint32_t v) const {
    const Vec place = in_.places[v].middle();
    Vec slope;  // along the axes of the index
    for (int axis = 0; axis < 3; ++axis) {
      Vec step;
      step[axis] = 0.3;
      slope[axis] = sampled_value(in_.nodes, place + step) - sampled_value(in_.nodes, place - step);
    }
    const Frame& frame = in_.nodes.frame();
    const Vec ascent = (1 / frame.determinant_mm3()) * (slope.x * cross(frame.column(1), frame.column(2)) +
                                                        slope.y * cross(frame.column(2), frame.column(0)) +
                                                        slope.z * cross(frame.column(0), frame.column(1)));
    const double size = length(ascent);
    return size > 0 ? (1 / size) * ascent : Vec{};
  }

  /// First heights: half as much again as the samples ask for.
  void guess() {
    const std::size_t count = in_.shell.facets.size();
    collar_.sampled_mm.assign(count, 0);
    std::vector<double> size(count);
    parallel_for(count, 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Triangle t = inward(in_, f);
        double longest = 0;
        for (std::size_t n = 0; n < 3; ++n)
          longest = std::max(longest, distance(world(in_, t[n]), world(in_, t[(n + 1) % 3])));
        size[f] = longest;
        for (const auto& weight : kSamples) {
          Vec place;
          Vec along;
          for (std::size_t n = 0; n < 3; ++n) {
            place = place + weight[n] * in_.places[t[n]].middle();
            along = along + weight[n] * collar_.directions[t[n]];
          }
          double& most = collar_.sampled_mm[f];
          most = std::max(most, sampled_distance(in_.nodes, place, along, most, std::max(longest, voxel_)));
        }
      }
    });
    for (std::size_t f = 0; f < count; ++f) {
      const double wanted = 1.5 * collar_.sampled_mm[f] + 0.04 * std::min(size[f], voxel_);
      for (const VertexId v : in_.shell.facets[f]) collar_.heights[v] = std::max(collar_.heights[v], wanted);
    }
  }

  void test(const std::vector<std::uint8_t>& is_due, int round) {
    const std::size_t count = in_.shell.facets.size();
    prisms_.resize(count);
    boxes_.resize(count);
    std::atomic<std::size_t> done{0};
    parallel_for(count, 128, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        if (!is_due[f] || progress_.cancelled()) continue;
        prisms_[f] = prism_of(in_, collar_, f);
        boxes_[f] = prisms_[f].box(-1, 1);
        collar_.faults[f] = faults_of(prisms_[f], f);
      }
      done += end - begin;
    });
    progress_.report({"verify", "collar, round " + std::to_string(round + 1), done, count, 0});
    if (progress_.cancelled()) return;
    note_changes(is_due);
    const std::vector<Box> changed = boxes_of(changed_);
    const BoxTree tree_of_changed(changed);
    std::vector<std::atomic<std::uint8_t>> crowded(count);
    parallel_for(count, 128, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end && !progress_.cancelled(); ++f) {
        if (!is_due[f]) continue;
        const auto meet = [&](std::uint32_t g) {
          if (g == f || (is_due[g] && g < f) || are_neighbours(f, g) || stay_apart(prisms_[f], prisms_[g])) return;
          crowded[f] = 1;
          crowded[g] = 1;
        };
        tree_->visit_meeting(boxes_[f], [&](std::uint32_t g) {
          if (!has_changed_[g]) meet(g);
        });
        tree_of_changed.visit_meeting(boxes_[f], [&](std::uint32_t n) { meet(changed_[n]); });
      }
    });
    for (std::size_t f = 0; f < count; ++f) {
      if (crowded[f] != 0) collar_.faults[f] |= kCrowded;
    }
  }

  /// The tree is of the first boxes; those that have changed since are in a list of their own.
  void note_changes(const std::vector<std::uint8_t>& is_due) {
    if (!tree_) {
      tree_.emplace(boxes_);
      has_changed_.assign(boxes_.size(), 0);
      return;
    }
    for (std::uint32_t f = 0; f < is_due.size(); ++f) {
      if (!is_due[f] || has_changed_[f]) continue;
      has_changed_[f] = 1;
      changed_.push_back(f);
    }
  }

  std::vector<Box> boxes_of(const std::vector<std::uint32_t>& facets) const {
    std::vector<Box> boxes;
    boxes.reserve(facets.size());
    for (const std::uint32_t f : facets) boxes.push_back(boxes_[f]);
    return boxes;
  }

  bool are_neighbours(std::size_t f, std::size_t g) const {
    for (const VertexId v : in_.shell.facets[f]) {
      for (const VertexId w : in_.shell.facets[g]) {
        if (v == w) return true;
      }
    }
    return false;
  }

  std::uint8_t faults_of(const Prism& prism, std::size_t facet) const {
    unsigned faults = kNoFault;
    for (const VertexId v : in_.shell.facets[facet]) {
      if (!winds_[v]) faults |= kVertex;
    }
    if (!unfolds(prism)) faults |= kFold;
    if (!has_side(in_.nodes, prism, 1, 1, kBoxesOfValue) || !has_side(in_.nodes, prism, -1, -1, kBoxesOfValue))
      faults |= kValue;
    if (!rises(in_.nodes, prism, kBoxesOfSlope)) faults |= kSlope;
    return static_cast<std::uint8_t>(faults);
  }

  /// Changes heights where facets fail; these, and all that they touch, are due again.
  void change(std::vector<std::uint8_t>& is_due, double factor) {
    constexpr std::uint8_t kTooHigh = kSlope | kFold | kCrowded;
    std::vector<std::uint8_t> wish(collar_.heights.size(), 0);  // 1: higher, 2: lower
    for (std::size_t f = 0; f < collar_.faults.size(); ++f) {
      const std::uint8_t faults = collar_.faults[f];
      if (faults == 0) continue;
      const bool higher = (faults & kValue) != 0;
      const bool lower = (faults & kTooHigh) != 0;
      if (higher == lower) continue;
      for (const VertexId v : in_.shell.facets[f]) wish[v] |= higher ? 1 : 2;
    }
    std::fill(is_due.begin(), is_due.end(), 0);
    for (std::uint32_t v = 0; v < wish.size(); ++v) {
      if (wish[v] == 0 || wish[v] == 3) continue;
      collar_.heights[v] *= wish[v] == 1 ? factor : 1 / factor;
      for (std::uint32_t n = in_.shell.star_begin[v]; n < in_.shell.star_begin[v + 1]; ++n)
        is_due[in_.shell.star[n]] = 1;
    }
    for (const std::uint32_t v : turned_) {
      for (std::uint32_t n = in_.shell.star_begin[v]; n < in_.shell.star_begin[v + 1]; ++n)
        is_due[in_.shell.star[n]] = 1;
    }
    turned_.clear();
    // Whom a facet was too near to is not kept: those are asked again.
    for (std::size_t f = 0; f < collar_.faults.size(); ++f) {
      if ((collar_.faults[f] & kCrowded) != 0) is_due[f] = 1;
    }
  }

  const CollarInput& in_;
  Progress& progress_;
  Collar collar_;
  std::vector<std::uint8_t> winds_;
  std::vector<std::uint32_t> turned_;  // vertices whose fibres have turned since the last test
  std::vector<Prism> prisms_;
  std::vector<Box> boxes_;
  std::optional<BoxTree> tree_;
  std::vector<std::uint8_t> has_changed_;
  std::vector<std::uint32_t> changed_;
  double voxel_ = 1;
};

}  // namespace

Collar find_collar(const CollarInput& input, int rounds, Progress& progress) {
  return Search(input, progress).run(rounds);
}

}  // namespace scantet::verify
