// Curves and corners of a domain: what a mesh must follow exactly, beside surfaces.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"
#include "scantet/base/stratum.h"

namespace SCANTET_API scantet {

/// A point where curves end or meet.
struct Corner {
  Point point;                  ///< world mm
  std::vector<Region> regions;  ///< that meet there, ascending; kOutside among them if it is
  std::string name;             ///< may be empty
};

/// A curve where three or more regions meet, a sharp edge, or a rim; without self-intersections, parametrised by arc
/// length, or by that of a polyline close beside it. Const methods may be called from many threads.
class Curve {
 public:
  /// The point of a curve that is nearest to another point.
  struct Nearest {
    Point point;         ///< world mm
    double along_mm;     ///< arc length from the start, 0 to length_mm()
    double distance_mm;  ///< to the point asked for
  };

  virtual ~Curve() = default;
  /// Its arc length, mm, > 0.
  virtual double length_mm() const = 0;
  /// The point at an arc length, world mm. along_mm: from the start, 0 to length_mm(); what is beyond is taken to the
  /// nearer end.
  virtual Point at(double along_mm) const = 0;
  /// The point nearest to p, world mm; of several the one with the least arc length.
  virtual Nearest nearest(const Point& p) const = 0;
  /// The regions around it, in the order in which they follow each other around it, right-handed about its direction,
  /// from any one on; kOutside among them if it is. Two equal ones in a row are parted by a sharp edge of one patch.
  virtual std::vector<Region> regions() const = 0;
  /// The corners at its start and end, as indices into Domain::corners(), the same twice if it comes back to its
  /// corner; none for a closed curve without a corner.
  virtual std::optional<std::array<std::size_t, 2>> corners() const = 0;
  /// What people call it, for mesh files. Default: no name.
  virtual std::string name() const { return {}; }
};

/// A curve of straight pieces.
class PolylineCurve final : public Curve {
 public:
  /// points: world mm, at least two, finite, and no two in a row equal; a closed curve ends where it starts. regions,
  /// corners, name: as the methods give them; regions and corners are not checked.
  /// Throws Error: usage.curve (fewer than two points, one that is not finite, two in a row that are equal, or no
  /// corners though the curve is not closed).
  PolylineCurve(std::vector<Point> points, std::vector<Region> regions,
                std::optional<std::array<std::size_t, 2>> corners, std::string name = {});

  double length_mm() const override { return along_mm_.back(); }
  Point at(double along_mm) const override;
  Nearest nearest(const Point& p) const override;
  std::vector<Region> regions() const override { return regions_; }
  std::optional<std::array<std::size_t, 2>> corners() const override { return corners_; }
  std::string name() const override { return name_; }

  /// As they were given, world mm.
  const std::vector<Point>& points() const { return points_; }

 private:
  std::vector<Point> points_;
  std::vector<double> along_mm_;  // of each point
  std::vector<Box> boxes_;        // of each kPerBox pieces
  std::vector<Region> regions_;
  std::optional<std::array<std::size_t, 2>> corners_;
  std::string name_;
};

}  // namespace scantet
