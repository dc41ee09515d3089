// The states come from whoever knows the boundary. Clear cubes are joined to clear blocks of twice the edge, again and
// again, so that a walk passes what is far from the boundary in few steps.
#include "scantet/domain/clearance_grid.h"

#include "scantet/base/box_clip.h"
#include "scantet/base/parallel.h"

namespace scantet {
namespace {

using Cube = std::array<int, 3>;

/// Halves of a range of cubes, until each is settled or a single cube.
class Halving {
 public:
  Halving(const CubeGrid& grid, const std::function<CubeState(const Box&)>& state_of, std::vector<CubeState>& states)
      : grid_(grid), state_of_(state_of), states_(states) {}

  void settle(const Cube& first, const Cube& last) {
    const CubeState state = state_of_(grid_.enlarged(first, last));
    if (state != CubeState::near || first == last) return fill(first, last, state);
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (last[axis] - first[axis] > last[longest] - first[longest]) longest = axis;
    }
    Cube lower_last = last;
    Cube upper_first = first;
    lower_last[longest] = first[longest] + (last[longest] - first[longest]) / 2;
    upper_first[longest] = lower_last[longest] + 1;
    settle(first, lower_last);
    settle(upper_first, last);
  }

 private:
  void fill(const Cube& first, const Cube& last, CubeState state) {
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        const auto row = states_.begin() + static_cast<std::ptrdiff_t>(grid_.index({first[0], y, z}));
        std::fill(row, row + (last[0] - first[0] + 1), state);
      }
    }
  }

  const CubeGrid& grid_;
  const std::function<CubeState(const Box&)>& state_of_;
  std::vector<CubeState>& states_;
};

/// The codes of blocks of twice the edge: that of the eight, if all are clear and alike and whole; else 0.
std::vector<std::uint8_t> join(const std::vector<std::uint8_t>& blocks, const Cube& counts, const Cube& doubled) {
  std::vector<std::uint8_t> joined(static_cast<std::size_t>(doubled[0]) * doubled[1] * doubled[2]);
  std::size_t at = 0;
  for (int z = 0; z < doubled[2]; ++z) {
    for (int y = 0; y < doubled[1]; ++y) {
      for (int x = 0; x < doubled[0]; ++x, ++at) {
        const auto code = [&](int i) -> std::uint8_t {
          const Cube block{2 * x + (i & 1), 2 * y + (i >> 1 & 1), 2 * z + (i >> 2)};
          if (block[0] >= counts[0] || block[1] >= counts[1] || block[2] >= counts[2]) return 1;  // beyond: outside
          return blocks[(static_cast<std::size_t>(block[2]) * counts[1] + block[1]) * counts[0] + block[0]];
        };
        joined[at] = code(0);
        for (int i = 1; i < 8; ++i) joined[at] = joined[at] == code(i) ? joined[at] : 0;
      }
    }
  }
  return joined;
}

}  // namespace

CubeGrid::CubeGrid(const Box& box, int along_longest) : origin(box.min) {
  const Vec extent = box.extent();
  edge_mm = std::max({extent.x, extent.y, extent.z}) / along_longest;
  constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
  for (const Point& p : {box.min, box.max}) {
    edge_mm = std::max(edge_mm, std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) * kRounding / kSlack);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double exact = std::ceil(extent[axis] / edge_mm);
    counts[static_cast<std::size_t>(axis)] = std::clamp(static_cast<int>(exact), 1, along_longest);
  }
}

Point CubeGrid::center(const Cube& cube) const {
  return origin + edge_mm * Vec{cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5};
}

Box CubeGrid::enlarged(const Cube& first, const Cube& last) const {
  const auto corner = [&](const Cube& cube, double shift) {
    return origin + edge_mm * Vec{cube[0] + shift, cube[1] + shift, cube[2] + shift};
  };
  return {corner(first, -kSlack), corner(last, 1 + kSlack)};
}

std::array<Cube, 2> CubeGrid::range(const Box& box) const {
  std::array<Cube, 2> found;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const auto cube = [&](double coordinate, double shift) {
      const double place = (coordinate - origin[axis]) / edge_mm + shift;
      return static_cast<int>(std::clamp(place, 0.0, counts[i] - 1.0));
    };
    found[0][i] = cube(box.min[axis], -2 * kSlack);
    found[1][i] = cube(box.max[axis], 2 * kSlack);
  }
  return found;
}

std::vector<CubeState> find_states(const CubeGrid& grid, const std::function<CubeState(const Box&)>& state_of) {
  constexpr int kPart = 16;  // cubes along the edge of what is worked on side by side
  std::vector<CubeState> states(grid.size());
  Cube parts;
  for (std::size_t axis = 0; axis < 3; ++axis) parts[axis] = (grid.counts[axis] + kPart - 1) / kPart;
  parallel_for(static_cast<std::size_t>(parts[0]) * parts[1] * parts[2], 1, [&](std::size_t part, std::size_t) {
    const int i = static_cast<int>(part);
    const Cube at{i % parts[0], i / parts[0] % parts[1], i / (parts[0] * parts[1])};
    Cube first;
    Cube last;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = kPart * at[axis];
      last[axis] = std::min(first[axis] + kPart, grid.counts[axis]) - 1;
    }
    Halving(grid, state_of, states).settle(first, last);
  });
  return states;
}

ClearanceGrid::ClearanceGrid(const CubeGrid& grid, const std::vector<CubeState>& states)
    : grid_(grid), per_mm_(1 / grid.edge_mm), codes_(grid.size()) {
  for (std::size_t i = 0; i < states.size(); ++i) codes_[i] = static_cast<Code>(states[i]);
  std::vector<Code> blocks = codes_;
  Cube counts = grid.counts;
  for (int level = 1; level <= kHighestLevel; ++level) {
    Cube doubled;
    for (std::size_t axis = 0; axis < 3; ++axis) doubled[axis] = (counts[axis] + 1) / 2;
    blocks = join(blocks, counts, doubled);
    counts = doubled;
    std::size_t at = 0;
    for (int z = 0; z < grid.counts[2]; ++z) {
      for (int y = 0; y < grid.counts[1]; ++y) {
        const std::size_t row = (static_cast<std::size_t>(z >> level) * counts[1] + (y >> level)) * counts[0];
        for (int x = 0; x < grid.counts[0]; ++x, ++at) {
          const Code state = blocks[row + static_cast<std::size_t>(x >> level)];
          if (state != 0) codes_[at] = static_cast<Code>(2 * level + state);
        }
      }
    }
  }
}

bool ClearanceGrid::cut(const std::array<double, 3>& from, const std::array<double, 3>& along, double& begin,
                        double& end) const {
  const Box box{{}, {double(grid_.counts[0]), double(grid_.counts[1]), double(grid_.counts[2])}};
  const auto stretch = clip_to_box({from[0], from[1], from[2]}, {along[0], along[1], along[2]}, box);
  if (!stretch) return false;
  begin = stretch->enter;
  end = stretch->leave;
  return true;
}

}  // namespace scantet
