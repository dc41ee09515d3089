// Text is read here, so that a fault can be named with its line; PLY is left to CGAL in a child process once its header
// is known to be sound.
#include "point_reader.h"

#include <CGAL/IO/read_ply_points.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "ply/ply_header.h"
#include "scantet/base/child_process.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/options.h"

namespace points {
namespace {

const char* const kAnew = "get the file anew from its source";
constexpr double kFarthest = 1e9;  // mm
constexpr double kSmallest = 1e-6;

void check_count(const std::string& file, std::uint64_t count) {
  if (count > kMostPoints) {
    refuse(file, std::to_string(count) + " points are more than " + std::to_string(kMostPoints),
           "thin them out, in MeshLab or CloudCompare for example");
  }
}

/// The numbers of a line, at most six of them; nullopt if there is anything else in it.
struct Line {
  std::array<double, 6> numbers{};
  std::size_t count = 0;
};
std::optional<Line> parse(const std::string& text) {
  Line line;
  const char* next = text.data();
  const char* const end = next + text.size();
  const auto skip = [&] { next = std::find_if(next, end, [](char c) { return c != ' ' && c != '\t' && c != '\r'; }); };
  for (skip(); next != end; skip()) {
    double number = 0;
    const auto [stop, code] = std::from_chars(*next == '+' ? next + 1 : next, end, number);
    if (code != std::errc{}) return std::nullopt;
    if (stop != end && *stop != ' ' && *stop != '\t' && *stop != '\r') return std::nullopt;
    next = stop;
    if (line.count < line.numbers.size()) line.numbers[line.count++] = number;
  }
  return line;
}

/// Reads "x y z" or "x y z nx ny nz" and more numbers a line, comments from # on; the first line may be the count
/// alone.
PointSet read_text(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  PointSet points;
  std::optional<double> stated;
  std::size_t columns = 0;
  std::string text;
  for (std::size_t number = 1; std::getline(stream, text); ++number) {
    const std::string where = "line " + std::to_string(number) + " ";
    text.resize(std::min(text.size(), text.find('#')));
    const std::optional<Line> line = parse(text);
    if (!line) refuse(file, where + "is not numbers with spaces between them", "write x y z or x y z nx ny nz, in mm");
    if (line->count == 0) continue;
    const auto& n = line->numbers;
    if (line->count == 1 && points.empty() && !stated) {
      stated = n[0];
      continue;
    }
    if (columns == 0) columns = line->count;
    if (line->count != columns || (columns != 3 && columns != 6)) {
      refuse(file, where + "has " + std::to_string(line->count) + " numbers",
             "write x y z on every line, or x y z nx ny nz on every line");
    }
    if (!std::all_of(n.begin(), n.end(), [](double x) { return std::isfinite(x); })) {
      refuse(file, where + "has a number that is not finite", kAnew);
    }
    points.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    check_count(file, points.size());
  }
  if (stated && *stated != static_cast<double>(points.size())) {
    refuse(file,
           "its first line says " + scantet::number_text(*stated) + " points, and there are " +
               std::to_string(points.size()),
           kAnew);
  }
  return points;
}

void check_ply(const std::string& file, const ply::Header& header) {
  std::uint64_t least = header.header_bytes;
  const std::uint64_t size = std::filesystem::file_size(file);
  for (const ply::Element& element : header.elements) {
    std::uint64_t bytes = 0;  // of one; in text a digit and what follows it, but for the last
    for (const ply::Property& property : element.properties) bytes += header.binary ? property.bytes : 2;
    if (element.count > size || least + element.count * bytes > size + 1) {
      refuse(file, "it ends before the " + std::to_string(element.count) + " of element " + element.name, kAnew);
    }
    least += element.count * bytes;
  }
  const ply::Element& vertices = *ply::vertices_of(header);
  check_count(file, vertices.count);
  if (const auto odd = ply::odd_coordinate(vertices)) {
    refuse(file, "property " + *odd + " of its vertices is not there as float or double",
           "export the points with x, y, z (and nx, ny, nz) as float or double");
  }
}

using Numbers = std::array<double, 6>;

/// For the child: CGAL's reading, and the points sent one after the other.
void send_ply(const std::string& file, std::uint64_t count, scantet::ChildLine& line) {
  std::ifstream stream(file, std::ios::binary);
  PointSet points;
  const bool read = CGAL::IO::read_PLY_with_properties<Oriented>(stream, std::back_inserter(points),
                                                                 CGAL::make_ply_point_reader(PointMap()),
                                                                 CGAL::make_ply_normal_reader(NormalMap()));
  if (!read || points.size() != count) {
    refuse(file, "its data cannot be read after " + std::to_string(points.size()) + " points", kAnew);
  }
  std::vector<Numbers> numbers;
  numbers.reserve(points.size());
  for (const auto& [p, n] : points) numbers.push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z()});
  line.step();
  line.send(numbers.data(), numbers.size() * sizeof(Numbers));
}

PointSet read_ply(const std::string& file, const scantet::Progress& progress) {
  const std::optional<ply::Header> header = ply::read_header(file);
  if (!header || !ply::is_point_set(*header)) refuse(file, "is not a PLY file of points", kAnew);
  check_ply(file, *header);
  const std::uint64_t count = ply::vertices_of(*header)->count;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file));
  const auto work = [&](scantet::ChildLine& line) { send_ply(file, count, line); };
  std::vector<Numbers> numbers(count);
  try {
    scantet::ChildProcess child(scantet::limits_for(bytes, 4, 64), work, [&] { return progress.cancelled(); });
    child.await_step();
    child.take([&](scantet::ChildLine& line) { line.receive(numbers.data(), numbers.size() * sizeof(Numbers)); });
  } catch (const scantet::ChildStopped&) {
    return {};
  } catch (const scantet::ChildFailure& failure) {
    refuse(file, std::string("CGAL's reading, in a process of its own, ") + failure.what(), kAnew);
  }
  PointSet points;
  points.reserve(numbers.size());
  for (const Numbers& n : numbers) {
    points.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    if (std::all_of(n.begin(), n.end(), [](double x) { return std::isfinite(x); })) continue;
    refuse(file, "point " + std::to_string(points.size()) + " has a number that is not finite", kAnew);
  }
  return points;
}

/// Keeps the first of the points at each place, in the order of the file.
void merge(PointSet& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a].first < points[b].first; });
  const auto end = std::unique(order.begin(), order.end(),
                               [&](std::size_t a, std::size_t b) { return points[a].first == points[b].first; });
  order.erase(end, order.end());
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) points[i] = points[order[i]];
  points.resize(order.size());
}

}  // namespace

bool is_point_file(const std::string& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code) || std::filesystem::file_size(file, code) == 0) return false;
  const std::string extension = scantet::file_extension(file);
  if (extension == ".xyz" || extension == ".pwn") return true;
  if (extension != ".ply") return false;
  const std::optional<ply::Header> header = ply::read_header(file);
  return header && ply::is_point_set(*header);
}

PointSet read_points(const std::string& file, const scantet::Progress& progress) {
  PointSet points = scantet::file_extension(file) == ".ply" ? read_ply(file, progress) : read_text(file);
  if (progress.cancelled()) return {};
  merge(points);
  if (points.size() < kFewestPoints) {
    refuse(file, "it has " + std::to_string(points.size()) + " different points",
           "a surface needs at least " + std::to_string(kFewestPoints) + ", and many more to be like the object");
  }
  scantet::Box box;
  for (const Oriented& point : points) box.extend(place_of(point));
  for (const scantet::Point& corner : {box.min, box.max}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(corner[axis]) <= kFarthest) continue;
      refuse(file,
             "a coordinate of " + scantet::number_text(corner[axis], 6) + " mm is beyond " +
                 scantet::number_text(kFarthest) + " mm",
             "check the unit; it must be mm");
    }
  }
  if (box.diagonal() < kSmallest) {
    refuse(file, "the points lie within " + scantet::number_text(box.diagonal(), 3) + " mm",
           "check the unit; it must be mm");
  }
  return points;
}

}  // namespace points
