// The mesher never looks outside of the box: an object that sticks out would be cut off without a word. Each face is
// asked at the nodes of a grid and along its lines, which finds every part that is wider than a cell of the grid. That
// smaller parts do not stick out is the plugin's promise.
#include "scantet/plugin/plugin_check.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/io/input_files.h"
#include "scantet/io/writable.h"

namespace scantet {
namespace {

constexpr int kLines = 17;  // each way on a face

std::string text_of(const Point& p) {
  return "(" + number_text(p.x, 6) + ", " + number_text(p.y, 6) + ", " + number_text(p.z, 6) + ")";
}

struct BoxCheck {
  const Domain& domain;
  const Box box;
  const std::string& input;
  const std::string plugin;

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw Error(Fault::input, "input.bounds",
                input + ": its box from " + text_of(box.min) + " to " + text_of(box.max) + " mm " + what, remedy);
  }
  [[noreturn]] void refuse(const std::string& what) const {
    refuse(what, "the box that plugin " + plugin + " gives must be finite and larger than the object");
  }
  /// Products of lengths have to be numbers, and differences of coordinates to have digits.
  void check_scale() const {
    constexpr double kSmallest =
        1e-15;  // mm; cubes from 1e-15 to 1e15 mm are meshed like others, those of 1e-20 and 1e20 mm are not
    constexpr double kLargest = 1e16;
    constexpr double kFarthest = 1e13;  // from the origin, in diagonals
    const double diagonal = box.diagonal();
    if (!(diagonal >= kSmallest && diagonal <= kLargest)) {
      refuse("is too " + std::string(diagonal < kSmallest ? "small" : "large") + " to compute with",
             "check the unit; scale it to a size between 1e-15 and 1e15 mm");
    }
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      farthest = std::max({farthest, std::abs(box.min[axis]), std::abs(box.max[axis])});
    }
    if (farthest > kFarthest * diagonal) {
      refuse("is so far from the origin that its coordinates have too few digits", "move it to the origin");
    }
  }
  double at(int axis, int i) const { return box.min[axis] + box.extent()[axis] * i / (kLines - 1); }

  /// In two calls, as a domain may be dear to ask.
  void check_face(int axis, double height) const {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::vector<Point> points;
    std::vector<Segment> lines;
    Point p;
    p[axis] = height;
    for (int i = 0; i < kLines; ++i) {
      for (int j = 0; j < kLines; ++j) {
        p[u] = at(u, i);
        p[v] = at(v, j);
        points.push_back(p);
      }
      Segment along_v{p, p};
      along_v.source[v] = box.min[v];
      lines.push_back(along_v);
      Segment along_u{p, p};
      along_u.source[v] = along_u.target[v] = at(v, i);
      along_u.source[u] = box.min[u];
      along_u.target[u] = box.max[u];
      lines.push_back(along_u);
    }
    std::vector<Region> regions(points.size());
    domain.regions_at(points, regions);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (regions[i] != kOutside) refuse("cuts the object: " + text_of(points[i]) + " on it is inside");
    }
    CrossingLists crossings;
    domain.crossings_of(lines, crossings);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!crossings[i].empty()) refuse("cuts the object at " + text_of(crossings[i].front().point));
    }
  }
};

void check_box(const Domain& domain, const std::string& input, const std::string& plugin, const Progress& progress) {
  const BoxCheck check{domain, domain.bounds(), input, plugin};
  if (!is_finite(check.box.min) || !is_finite(check.box.max)) check.refuse("is not finite");
  if (check.box.empty()) check.refuse("is empty");
  check.check_scale();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double height : {check.box.min[axis], check.box.max[axis]}) {
      if (!progress.cancelled()) check.check_face(axis, height);
    }
  }
}

[[noreturn]] void blame(const InputPlugin& plugin, const std::string& input, const std::string& what) {
  throw Error(Fault::internal, "internal.plugin", input + ": plugin " + plugin.name() + " " + what,
              "tell the plugin's author");
}

template <class Act>
auto act_blaming(const InputPlugin& plugin, const std::string& input, const Act& act) {
  try {
    return act();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    blame(plugin, input, std::string("failed: ") + error.what());
  }
}

}  // namespace

OpenedDomain open_checked(InputPlugin& plugin, const std::string& input, Progress& progress) {
  OpenedDomain opened = act_blaming(plugin, input, [&] { return plugin.open(input, progress); });
  if (progress.cancelled()) return opened;
  if (opened.domain == nullptr) blame(plugin, input, "opened nothing, and was not cancelled");
  if (!(opened.default_size_mm > 0) || !std::isfinite(opened.default_size_mm)) {
    blame(plugin, input, "gives no usable size by default: " + number_text(opened.default_size_mm) + " mm");
  }
  act_blaming(plugin, input, [&] { check_box(*opened.domain, input, plugin.name(), progress); });
  return opened;
}

bool convert_checked(InputPlugin& plugin, const std::string& input, const std::string& output, Progress& progress,
                     const std::vector<std::string>& also_read) {
  std::vector<std::string> read = input_files(input);
  read.insert(read.end(), also_read.begin(), also_read.end());
  check_writable({output}, read);
  const bool done = act_blaming(plugin, input, [&] { return plugin.convert(input, output, progress); });
  if (!done) {
    if (!progress.cancelled()) blame(plugin, input, "did not write " + output + ", and was not cancelled");
    return false;
  }
  if (!std::filesystem::exists(output)) blame(plugin, input, "did not write " + output);
  return true;
}

}  // namespace scantet
