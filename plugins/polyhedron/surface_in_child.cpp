// CGAL's reader believes the sizes that a file names, and its repair of surfaces ends the process at some that are
// degenerate. The child sends points and triangles, of which the surface is built again.
#include "surface_in_child.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>

#include "scantet/base/child_process.h"
#include "scantet/base/error.h"

namespace polyhedron {
namespace {

using scantet::ChildLine;
using Coordinates = std::array<double, 3>;
using Corners = std::array<std::uint32_t, 3>;

template <class Value>
void send_all(ChildLine& line, const std::vector<Value>& values) {
  line.put(values.size());
  line.send(values.data(), values.size() * sizeof(Value));
}

template <class Value>
std::vector<Value> take_all(ChildLine& line) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 20;  // memory grows with what has come, whatever is announced
  std::vector<Value> values;
  for (auto left = line.take<std::size_t>(); left > 0;) {
    const std::size_t count = std::min(left, kAtOnce);
    values.resize(values.size() + count);
    line.receive(&values[values.size() - count], count * sizeof(Value));
    left -= count;
  }
  return values;
}

/// Triangles begin with the target of their halfedge, as add_face() will have it.
void send(ChildLine& line, const ReadSurface& read) {
  const Surface& surface = *read.surface;
  line.put(read.repairs.size());
  for (const std::string& repair : read.repairs) line.put_text(repair);
  std::vector<Coordinates> points;
  for (const Surface::Vertex_index v : surface.vertices()) {
    const Kernel::Point_3& p = surface.point(v);
    points.push_back({p.x(), p.y(), p.z()});
  }
  send_all(line, points);
  std::vector<Corners> triangles;
  for (const Surface::Face_index f : surface.faces()) {
    const Surface::Halfedge_index h = surface.halfedge(f);
    triangles.push_back({surface.target(h), surface.target(surface.next(h)), surface.source(h)});
  }
  send_all(line, triangles);
}

ReadSurface take(ChildLine& line) {
  ReadSurface read;
  for (auto count = line.take<std::size_t>(); count > 0; --count) read.repairs.push_back(line.take_text());
  Surface& surface = read.surface.emplace();
  for (const auto& [x, y, z] : take_all<Coordinates>(line)) surface.add_vertex({x, y, z});
  for (const Corners& triangle : take_all<Corners>(line)) {
    std::array<Surface::Vertex_index, 3> corners;
    for (std::size_t n = 0; n < 3; ++n) {
      if (triangle[n] >= surface.number_of_vertices()) throw scantet::ChildFailure("sends nonsense");
      corners[n] = Surface::Vertex_index(triangle[n]);
    }
    if (surface.add_face(corners) == Surface::null_face()) throw scantet::ChildFailure("sends nonsense");
  }
  return read;
}

}  // namespace

ReadSurface read_surface_apart(const std::string& file, bool repair, scantet::Progress& progress) {
  std::error_code code;
  const auto size = static_cast<double>(std::filesystem::file_size(file, code));
  const double bytes = code ? 0 : size;  // who reads says what is wrong
  const auto work = [&](ChildLine& line) {
    scantet::SentProgress sent(line);
    const ReadSurface read = read_surface(file, repair, sent);
    line.step();
    send(line, read);
  };
  try {
    scantet::ChildProcess child(scantet::limits_for(bytes, 4, 64), work, [&] { return progress.cancelled(); });
    child.await_step([&](const std::string& doing, std::uint64_t done, std::uint64_t) {
      progress.report({"read", doing, done, std::nullopt, 0});
    });
    return child.take(take);
  } catch (const scantet::ChildStopped&) {
    return {};
  } catch (const scantet::ChildFailure& failure) {
    throw scantet::Error(
        scantet::Fault::input, "input.surface",
        file + ": CGAL's reading" + (repair ? " and repair" : "") + ", in a process of its own, " + failure.what(),
        repair ? "repair it elsewhere, in MeshLab for example" : "get the file anew from its source");
  }
}

}  // namespace polyhedron
