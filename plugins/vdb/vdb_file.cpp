// Every call into OpenVDB goes through guarded(), which turns its exceptions into ours. Heads are read without values;
// only the grid that is wanted is read whole. OpenVDB believes the length of any text, and fills gigabytes before it
// finds that the file has ended: so the heads are walked through here first.
#include "vdb_file.h"

#include <algorithm>
#include <array>
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

constexpr const char* kTypes = "float, double, int32, int64, bool";
constexpr int kUuid = 36;

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

template <class Number>
void read_number(std::istream& in, Number& number) {
  in.read(reinterpret_cast<char*>(&number), sizeof number);
}

/// Goes through a file, in which texts and values of metadata come after their lengths in bytes.
class HeadWalk {
 public:
  explicit HeadWalk(const std::string& file)
      : file_(file), in_(file, std::ios::binary), size_(static_cast<std::int64_t>(fs::file_size(file))) {
    in_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
  }
  std::int64_t size() const { return size_; }
  void go_to(std::int64_t place) { in_.seekg(place); }
  template <class Value>
  Value take() {
    Value value{};
    read_number(in_, value);
    return value;
  }
  std::string text() {
    std::string text(checked(take<std::uint32_t>()), '\0');
    in_.read(text.data(), static_cast<std::streamsize>(text.size()));
    return text;
  }
  void pass_metadata() {
    for (auto left = take<std::uint32_t>(); left > 0; --left) {
      if (text().empty()) refuse_damaged(file_, "a value in its head has no name");
      text();  // the type
      in_.seekg(checked(take<std::uint32_t>()), std::ios::cur);
    }
  }

 private:
  std::uint32_t checked(std::uint32_t length) {
    if (length <= size_ - in_.tellg()) return length;
    refuse_damaged(file_, "a text or value in its head is longer than the file, " + std::to_string(length) + " bytes");
  }

  const std::string& file_;
  std::ifstream in_;
  std::int64_t size_;
};

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
  head.mask = is_mask(grid);
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
  guarded(file, [&] {
    HeadWalk walk(file);
    walk.go_to(sizeof(std::uint64_t));  // after what every .vdb file begins with
    const auto version = walk.take<std::uint32_t>();
    walk.take<std::uint64_t>();  // the library's version
    const auto has_offsets = walk.take<char>();
    if (version < openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION) return;  // OpenVDB 1 and older
    if (version > openvdb::OPENVDB_FILE_VERSION) {
      refuse_damaged(file, "its version, " + std::to_string(version) + ", is newer than OpenVDB knows, " +
                               std::to_string(openvdb::OPENVDB_FILE_VERSION));
    }
    if (has_offsets == 0) return;
    walk.take<std::array<char, kUuid>>();
    walk.pass_metadata();
    for (auto left = walk.take<std::int32_t>(); left > 0; --left) {
      const std::string name = walk.text();
      walk.text();  // the type
      walk.text();  // the grid whose tree it shares
      const auto begin = walk.take<std::int64_t>();
      const auto values = walk.take<std::int64_t>();
      const auto end = walk.take<std::int64_t>();
      if (!(0 < begin && begin <= values && values <= end && end <= walk.size())) {
        refuse_damaged(file, "its " + std::to_string(walk.size()) + " bytes end before the grid " +
                                 openvdb::io::GridDescriptor::nameAsString(name) + " does");
      }
      walk.go_to(begin);
      walk.take<std::uint32_t>();  // how values are compressed
      walk.pass_metadata();
      walk.text();  // the kind of transform
      walk.go_to(end);
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
