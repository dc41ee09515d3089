// OpenVDB and the blosc within it write past their memory on some damaged files, and believe sizes. The child reads the
// grid and sends what the field is made of, the leaves' values as they are: one copy through a socket. A node of a file
// has its masks uncompressed, so that a tree takes at most 64 times its file.
// OpenVDB's log4cplus has threads, which are not in the child: exit() would wait for them there, _exit() does not.
#include "grid_in_child.h"

#include <array>
#include <filesystem>

#include "scantet/base/child_process.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"

namespace vdb {
namespace {

using scantet::ChildLine;
using scantet::ChildProcess;
using scantet::Error;
using scantet::Fault;

constexpr std::size_t kLeafNodes = std::size_t{kBlockSide} * kBlockSide * kBlockSide;
constexpr int kMostNodes = 8'192;  // along an axis

void send_head(ChildLine& line, const GridHead& head) {
  for (const std::string& text : {head.name, head.value_type, head.grid_class}) line.put_text(text);
  line.put(std::array{head.level_set, head.supported, head.affine, head.mask});
}

GridHead take_head(ChildLine& line) {
  GridHead head;
  for (std::string* text : {&head.name, &head.value_type, &head.grid_class}) *text = line.take_text();
  const auto flags = line.take<std::array<bool, 4>>();
  head.level_set = flags[0];
  head.supported = flags[1];
  head.affine = flags[2];
  head.mask = flags[3];
  return head;
}

void send_frame(ChildLine& line, const scantet::Frame& frame) {
  line.put(std::array{frame.column(0), frame.column(1), frame.column(2)});
  line.put(frame.origin());
}

scantet::Frame take_frame(ChildLine& line) {
  const auto columns = line.take<std::array<scantet::Vec, 3>>();
  return {columns, line.take<scantet::Point>()};
}

template <class Value>
void send_values(ChildLine& line, const SparseValues<Value>& values) {
  line.put(values.size);
  line.put(values.background);
  line.put(values.tiles.size());
  for (const Tile<Value>& tile : values.tiles) line.put(tile);
  line.put(values.leaves.size());
  for (const Leaf<Value>& leaf : values.leaves) {
    line.put(leaf.block);
    line.send(leaf.values, kLeafNodes * sizeof(Value));
  }
}

/// Blocks of the box; what lies outside of it is nonsense.
bool is_within(const Index& block, int side, const Index& size) {
  if (side < 1 || side > kMostNodes) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (block[axis] < 0 || block[axis] + std::int64_t{side} - 1 > size[axis] >> kBlockShift) return false;
  }
  return true;
}

[[noreturn]] void refuse_nonsense() {
  throw scantet::ChildFailure("sends nonsense");
}

template <class Value>
SparseValues<Value> take_values(ChildLine& line) {
  constexpr std::size_t kMost = std::size_t{1} << 30;
  SparseValues<Value> values;
  values.size = line.take<Index>();
  for (const int n : values.size) {
    if (n < 1 || n > kMostNodes) refuse_nonsense();
  }
  values.background = line.take<Value>();
  const auto tiles = line.take<std::size_t>();
  if (tiles > kMost) refuse_nonsense();
  for (std::size_t n = 0; n < tiles; ++n) {
    values.tiles.push_back(line.take<Tile<Value>>());
    if (!is_within(values.tiles.back().block, values.tiles.back().side, values.size)) refuse_nonsense();
  }
  const auto leaves = line.take<std::size_t>();
  if (leaves > kMost) refuse_nonsense();
  auto memory = std::make_shared_for_overwrite<Value[]>(leaves * kLeafNodes);
  values.leaves.reserve(leaves);
  for (std::size_t n = 0; n < leaves; ++n) {
    Value* const place = memory.get() + n * kLeafNodes;
    values.leaves.push_back({line.take<Index>(), place});
    if (!is_within(values.leaves.back().block, 1, values.size)) refuse_nonsense();
    line.receive(place, kLeafNodes * sizeof(Value));
  }
  values.owner = std::shared_ptr<const void>(memory, memory.get());
  return values;
}

void send_grid(ChildLine& line, const Grid& grid) {
  send_head(line, grid.head);
  send_frame(line, grid.frame);
  line.put(grid.origin);
  line.put(grid.first);
  line.put(std::array{grid.min_value, grid.max_value, grid.background});
  line.put(std::array{grid.active_voxels, grid.memory_bytes});
  line.put(grid.values.index());
  std::visit([&](const auto& values) { send_values(line, values); }, grid.values);
}

Grid take_grid(ChildLine& line) {
  Grid grid;
  grid.head = take_head(line);
  grid.frame = take_frame(line);
  grid.origin = line.take<Index>();
  grid.first = line.take<Index>();
  const auto range = line.take<std::array<double, 3>>();
  grid.min_value = range[0];
  grid.max_value = range[1];
  grid.background = range[2];
  const auto counts = line.take<std::array<std::int64_t, 2>>();
  grid.active_voxels = counts[0];
  grid.memory_bytes = counts[1];
  switch (line.take<std::size_t>()) {
    case 0:
      grid.values = take_values<float>(line);
      return grid;
    case 1:
      grid.values = take_values<double>(line);
      return grid;
    case 2:
      grid.values = take_values<std::int32_t>(line);
      return grid;
    default:
      grid.values = take_values<std::int64_t>(line);
      return grid;
  }
}

scantet::ChildLimits limits_of(const std::string& file) {
  constexpr double kMostExpansion = 64;
  std::error_code code;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file, code));
  return scantet::limits_for(code ? 0 : bytes, 1, 4 + kMostExpansion);
}

/// work(line) in a child, and then take(line) here; nothing if it was cancelled.
template <class Work, class Take>
auto apart(const std::string& file, const scantet::Progress& progress, const Work& work, const Take& take)
    -> std::optional<decltype(take(std::declval<ChildLine&>()))> {
  try {
    const auto on_one_thread = [&](ChildLine& line) { scantet::with_threads(1, [&] { work(line); }); };
    ChildProcess child(limits_of(file), on_one_thread, [&] { return progress.cancelled(); });
    child.await_step();
    return child.take(take);
  } catch (const scantet::ChildStopped&) {
    return std::nullopt;
  } catch (const scantet::ChildFailure& failure) {
    throw Error(Fault::input, "input.corrupt", file + ": damaged: OpenVDB, in a process of its own, " + failure.what(),
                "get the file anew from its source");
  }
}

}  // namespace

std::vector<GridHead> read_heads_apart(const std::string& file, const scantet::Progress& progress) {
  const auto work = [&](ChildLine& line) {
    const std::vector<GridHead> heads = read_heads(file);
    line.step();
    line.put(heads.size());
    for (const GridHead& head : heads) send_head(line, head);
  };
  const auto take = [](ChildLine& line) {
    std::vector<GridHead> heads;
    for (auto left = line.take<std::size_t>(); left > 0; --left) heads.push_back(take_head(line));
    return heads;
  };
  return apart(file, progress, work, take).value_or(std::vector<GridHead>());
}

std::optional<Grid> read_grid_apart(const std::string& file, const std::optional<std::string>& name,
                                    const scantet::Progress& progress) {
  const auto work = [&](ChildLine& line) {
    const Grid grid = read_grid(file, name);
    line.step();
    send_grid(line, grid);
  };
  return apart(file, progress, work, take_grid);
}

}  // namespace vdb
