// A line is followed from vertex to vertex: of the edges at a vertex the one goes on whose other end lies on the piece
// and is nearer to its end. Vertices at the same place count as one: a surface may touch itself.
#include "edge_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/options.h"
#include "triangle_grid.h"

namespace polyhedron {
namespace {

using scantet::Point;
using scantet::Vec;

[[noreturn]] void refuse(const std::string& place, const std::string& what) {
  throw scantet::Error(scantet::Fault::input, "input.edges", place + ": " + what,
                       "give lines along edges of the surface: elements \"l\" of an .obj file, or lines of text with "
                       "the number of points and their coordinates; or an angle");
}

std::string text_of(const Point& p) {
  using scantet::number_text;
  return "(" + number_text(p.x, 6) + ", " + number_text(p.y, 6) + ", " + number_text(p.z, 6) + ") mm";
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

template <class Number>
Number number_in(const std::string& word, const std::string& place) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, number);
  constexpr std::size_t kLongest = 40;
  if (code == std::errc{} && stop == end) return number;
  refuse(place, "'" + word.substr(0, kLongest) + "' is no number that can stand there");
}

Point point_in(const std::vector<std::string>& words, std::size_t first, const std::string& place) {
  Point p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = number_in<double>(words[first + static_cast<std::size_t>(axis)], place);
    if (!std::isfinite(p[axis])) refuse(place, "a coordinate is not finite");
  }
  return p;
}

/// "l 1 2 3" or "l 1/1 2/2", the first number of each being the vertex, from 1 on, or from -1 backwards.
std::vector<Point> points_of_obj(const std::vector<std::string>& words, const std::vector<Point>& vertices,
                                 const std::string& place) {
  std::vector<Point> points;
  for (std::size_t n = 1; n < words.size(); ++n) {
    const auto number = number_in<std::int64_t>(words[n].substr(0, words[n].find('/')), place);
    const auto count = static_cast<std::int64_t>(vertices.size());
    const std::int64_t index = number < 0 ? count + number : number - 1;
    if (index < 0 || index >= count) refuse(place, "there is no vertex " + std::to_string(number));
    points.push_back(vertices[static_cast<std::size_t>(index)]);
  }
  return points;
}

/// "3  0 0 0  1 0 0  1 1 0".
std::vector<Point> points_of_polyline(const std::vector<std::string>& words, const std::string& place) {
  const auto count = number_in<std::uint32_t>(words[0], place);
  if (words.size() != 1 + std::size_t{3} * count) {
    refuse(place, std::to_string(count) + " points have " + std::to_string(std::size_t{3} * count) +
                      " coordinates, and there are " + std::to_string(words.size() - 1) + " numbers");
  }
  std::vector<Point> points;
  for (std::size_t n = 0; n < count; ++n) points.push_back(point_in(words, 1 + 3 * n, place));
  return points;
}

/// Goes along the edges of a surface.
class Walk {
 public:
  explicit Walk(const Surface& surface) : surface_(surface) {
    for (const Surface::Vertex_index v : surface.vertices()) {
      const Point p = from_cgal(surface.point(v));
      at_[{p.x, p.y, p.z}].push_back(v);
      box_.extend(p);
    }
    constexpr double kShare = 1e-6;
    near_mm_ = kShare * distance(box_.min, box_.max);
    for (const auto& [place, vertices] : at_) places_.push_back(place);
  }

  /// The place of the vertex at p; nullopt if there is none. places_ is ascending by x.
  std::optional<std::array<double, 3>> place_of(const Point& p) const {
    std::optional<std::array<double, 3>> best;
    double least = near_mm_;
    auto place = std::lower_bound(places_.begin(), places_.end(), p.x - near_mm_,
                                  [](const std::array<double, 3>& a, double x) { return a[0] < x; });
    for (; place != places_.end() && (*place)[0] <= p.x + near_mm_; ++place) {
      const double apart = distance(point(*place), p);
      if (apart > least) continue;
      least = apart;
      best = *place;
    }
    return best;
  }

  void along(const Point& from, const Point& to, const std::string& place, FollowedLines& found) const {
    const auto begin = place_of(from);
    const auto end = place_of(to);
    if (!begin || !end) refuse(place, "the surface has no vertex at " + text_of(begin ? to : from));
    auto at = *begin;
    while (at != *end) {
      const auto step = next(at, point(*begin), point(*end));
      if (!step) {
        refuse(place, "the line from " + text_of(from) + " to " + text_of(to) +
                          " does not run along edges of the surface, from " + text_of(point(at)) + " on");
      }
      found.edges.insert(step->first);
      at = step->second;
    }
  }

 private:
  using Place = std::array<double, 3>;
  static Point point(const Place& place) { return {place[0], place[1], place[2]}; }

  /// The edge that leads on, and where to.
  std::optional<std::pair<Surface::Edge_index, Place>> next(const Place& at, const Point& begin,
                                                            const Point& end) const {
    const Vec along = (1 / distance(begin, end)) * (end - begin);
    std::optional<std::pair<Surface::Edge_index, Place>> best;
    double least = std::numeric_limits<double>::infinity();
    const double here = dot(point(at) - begin, along);
    for (const Surface::Vertex_index v : at_.at(at)) {
      for (const auto h : CGAL::halfedges_around_target(v, surface_)) {
        const Point other = from_cgal(surface_.point(surface_.source(h)));
        const double there = dot(other - begin, along);
        const double off = distance(other, begin + there * along);
        if (off > near_mm_ || there <= here || there > distance(begin, end) + near_mm_ || there >= least) continue;
        least = there;
        best.emplace(surface_.edge(h), Place{other.x, other.y, other.z});
      }
    }
    return best;
  }

  const Surface& surface_;
  std::map<Place, std::vector<Surface::Vertex_index>> at_;
  std::vector<Place> places_;
  scantet::Box box_;
  double near_mm_ = 0;
};

}  // namespace

std::vector<EdgeLine> read_edge_lines(const std::string& file) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) refuse("'" + file + "'", "no angle in degrees, and no file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse("'" + file + "'", "it cannot be read");
  const bool is_obj = scantet::file_extension(file) == ".obj";
  std::vector<EdgeLine> lines;
  std::vector<Point> vertices;
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    const std::string place = file + ":" + std::to_string(number);
    const std::vector<std::string> words = words_of(text);
    if (words.empty() || words[0][0] == '#') continue;
    if (is_obj && words[0] == "v") {
      if (words.size() < 4) refuse(place, "a vertex without three coordinates");
      vertices.push_back(point_in(words, 1, place));
    }
    if (is_obj && words[0] != "l") continue;
    EdgeLine line{is_obj ? points_of_obj(words, vertices, place) : points_of_polyline(words, place), place};
    if (line.points.size() < 2) refuse(place, "a line of fewer than two points");
    lines.push_back(std::move(line));
  }
  if (lines.empty()) refuse(file, "there are no lines in it");
  return lines;
}

FollowedLines follow_lines(const Surface& surface, const std::vector<EdgeLine>& lines) {
  const Walk walk(surface);
  FollowedLines found;
  for (const EdgeLine& line : lines) {
    for (std::size_t n = 1; n < line.points.size(); ++n) {
      walk.along(line.points[n - 1], line.points[n], line.place, found);
    }
    const auto begin = walk.place_of(line.points.front());
    const auto end = walk.place_of(line.points.back());
    if (begin == end) continue;
    found.ends.insert(*begin);
    found.ends.insert(*end);
  }
  return found;
}

}  // namespace polyhedron
