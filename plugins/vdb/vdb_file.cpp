// Every call into OpenVDB goes through guarded(), which turns its exceptions into ours. Heads are read without values;
// only the grid that is wanted is read whole.
#include "vdb_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <new>

#include "scantet/base/error.h"
#include "tree_values.h"
#include "vdb_grid.h"

namespace vdb {
namespace {

namespace fs = std::filesystem;
using scantet::Error;
using scantet::Fault;

constexpr const char* kTypes = "float, double, int32, int64";

[[noreturn]] void refuse_damaged(const std::string& file, const std::string& what) {
  throw Error(Fault::input, "input.corrupt", file + ": damaged or not complete: " + what,
              "get the file anew from its source");
}

/// What act() returns; OpenVDB's exceptions come out as input.corrupt.
template <class Act>
auto guarded(const std::string& file, const Act& act) {
  try {
    return act();
  } catch (const Error&) {
    throw;
  } catch (const std::ios_base::failure&) {
    refuse_damaged(file, "it ends in its head");
  } catch (const std::bad_alloc&) {
    refuse_damaged(file, "it asks for more memory than there is");
  } catch (const std::exception& error) {
    refuse_damaged(file, error.what());
  }
}

/// What a file says before its grids.
struct Preamble {
  std::uint64_t magic = 0;
  std::uint32_t file_version = 0;
  std::uint32_t library_version[2] = {0, 0};
  char has_offsets = 0;
};

template <class Number>
void read_number(std::istream& in, Number& number) {
  in.read(reinterpret_cast<char*>(&number), sizeof number);
}

void check_start(const std::string& file) {
  std::error_code code;
  if (!fs::exists(file, code)) {
    throw Error(Fault::input, "input.not_found", file + ": no such file", "check the path");
  }
  if (!fs::is_regular_file(file, code)) {
    throw Error(Fault::input, "input.format", file + ": not a file", "name a .vdb file");
  }
  if (fs::file_size(file, code) == 0) {
    throw Error(Fault::input, "input.empty", file + ": the file is empty", "get the file anew from its source");
  }
  std::uint64_t magic = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(Fault::input, "input.not_found", file + ": cannot be read", "check its permissions");
  read_number(in, magic);
  if (!in || magic != static_cast<std::uint64_t>(openvdb::OPENVDB_MAGIC)) {
    throw Error(Fault::input, "input.format", file + ": not a .vdb file: it does not begin as one",
                "check that it is the right file");
  }
  openvdb::initialize();
  check_complete(file);
}

GridHead head_of(const openvdb::GridBase& grid, const std::string& name) {
  GridHead head;
  head.name = name;
  head.value_type = grid.valueType();
  head.grid_class = openvdb::GridBase::gridClassToString(grid.getGridClass());
  head.level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  head.supported = is_supported(grid);
  head.affine = grid.transform().isLinear();
  return head;
}

std::vector<GridHead> heads_of(openvdb::io::File& in, const std::string& file) {
  std::vector<GridHead> heads;
  for (auto name = in.beginName(); name != in.endName(); ++name) {
    const std::string unique = *name;
    heads.push_back(head_of(*in.readGridMetadata(unique), unique));
  }
  if (!heads.empty()) return heads;
  throw Error(Fault::input, "input.grid", file + ": there is no grid in it", "check that it is the right file");
}

std::string list_of(const std::vector<GridHead>& heads) {
  std::string list;
  for (const GridHead& head : heads) list += (list.empty() ? "" : ", ") + head.name + " (" + head.value_type + ")";
  return list;
}

GridHead choose(const std::vector<GridHead>& heads, const std::string& file, const std::optional<std::string>& name) {
  std::vector<GridHead> fit;
  for (const GridHead& head : heads) {
    if (name ? head.name == *name : head.supported) fit.push_back(head);
  }
  if (fit.size() == 1 && fit.front().supported) return fit.front();
  if (name && fit.empty()) {
    throw Error(Fault::usage, "usage.grid", "--grid: " + file + " has no grid named " + *name,
                "choose one of " + list_of(heads));
  }
  if (fit.size() > 1) {
    throw Error(Fault::usage, "usage.grid", "--grid is missing: " + file + " has several grids",
                "choose one of " + list_of(fit));
  }
  throw Error(Fault::input, "input.grid",
              file + ": no grid of a scalar type" + (name ? " named " + *name : "") + "; it has " + list_of(heads),
              std::string("the types that can be meshed are ") + kTypes);
}

scantet::Frame frame_of(const openvdb::math::Transform& transform, const Index& origin, const std::string& where) {
  if (!transform.isLinear()) {
    throw Error(Fault::input, "input.frame", where + ": its transform is a frustum's, and not affine",
                "resample it to a grid with an affine transform");
  }
  const openvdb::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();  // of rows: a point stands before it
  const auto row = [&](int n) { return scantet::Vec{m(n, 0), m(n, 1), m(n, 2)}; };
  try {
    const scantet::Frame frame({row(0), row(1), row(2)}, row(3));
    const scantet::Vec first{double(origin[0]), double(origin[1]), double(origin[2])};
    return {{row(0), row(1), row(2)}, frame.to_world(first)};
  } catch (const Error&) {
    throw Error(Fault::input, "input.frame", where + ": the axes of its transform do not span space",
                "correct the transform in the program that wrote it");
  }
}

}  // namespace

void check_complete(const std::string& file) {
  namespace io = openvdb::io;
  guarded(file, [&] {
    std::ifstream in(file, std::ios::binary);
    Preamble start;
    read_number(in, start.magic);
    read_number(in, start.file_version);
    read_number(in, start.library_version[0]);
    read_number(in, start.library_version[1]);
    read_number(in, start.has_offsets);
    if (!in) refuse_damaged(file, "it ends in its head");
    if (start.file_version < openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION) return;  // OpenVDB 1 and older
    if (start.file_version > openvdb::OPENVDB_FILE_VERSION) {
      refuse_damaged(file, "its version, " + std::to_string(start.file_version) + ", is newer than OpenVDB knows, " +
                               std::to_string(openvdb::OPENVDB_FILE_VERSION));
    }
    if (start.has_offsets == 0) return;
    constexpr int kUuid = 36;
    in.ignore(kUuid);
    io::setVersion(in, {start.library_version[0], start.library_version[1]}, start.file_version);
    in.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::MetaMap().readMeta(in);
    std::int32_t grids = 0;
    read_number(in, grids);
    const auto size = static_cast<std::int64_t>(fs::file_size(file));
    for (std::int32_t n = 0; n < grids; ++n) {
      io::GridDescriptor grid;
      grid.read(in);
      const bool in_order =
          0 < grid.getGridPos() && grid.getGridPos() <= grid.getBlockPos() && grid.getBlockPos() <= grid.getEndPos();
      if (!in_order || grid.getEndPos() > size) {
        refuse_damaged(file, "its " + std::to_string(size) + " bytes end before the grid " +
                                 io::GridDescriptor::nameAsString(grid.uniqueName()) + " does");
      }
      grid.seekToEnd(in);
    }
  });
}

std::vector<GridHead> read_heads(const std::string& file) {
  check_start(file);
  return guarded(file, [&] {
    openvdb::io::File in(file);
    in.open(false);
    return heads_of(in, file);
  });
}

Grid read_grid(const std::string& file, const std::optional<std::string>& name) {
  check_start(file);
  return guarded(file, [&] {
    openvdb::io::File in(file);
    in.open(false);
    Grid grid;
    grid.head = choose(heads_of(in, file), file, name);
    const std::string where = file + ": grid " + grid.head.name;
    const openvdb::GridBase::ConstPtr source = in.readGrid(grid.head.name);
    take_values(source, where, grid);
    grid.frame = frame_of(source->transform(), grid.origin, where);
    return grid;
  });
}

}  // namespace vdb
