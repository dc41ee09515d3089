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
  std::vector<Region> regions;  ///< that meet there, ascending
  std::string name;             ///< may be empty
};

/// A curve where three or more regions meet, a sharp edge, or a rim; without self-intersections, parametrised by arc
/// length. Const methods may be called from many threads.
class Curve {
 public:
  /// The point of a curve that is nearest to another point.
  struct Nearest {
    Point point;         ///< world mm
    double along_mm;     ///< arc length from the start
    double distance_mm;  ///< to the point asked for
  };

  virtual ~Curve() = default;
  /// > 0, mm.
  virtual double length_mm() const = 0;
  /// along_mm: arc length from the start, 0 to length_mm(); what is beyond is taken to the nearer end.
  virtual Point at(double along_mm) const = 0;
  /// The one nearest to p; of several the one with the least arc length.
  virtual Nearest nearest(const Point& p) const = 0;
  /// The regions around it, in the order in which they follow each other around it, right-handed about its direction,
  /// from any one on; kOutside among them if it is. Two equal ones in a row are parted by a sharp edge of one patch.
  virtual std::vector<Region> regions() const = 0;
  /// The corners at its start and end, as indices into Domain::corners(); none for a closed curve.
  virtual std::optional<std::array<std::size_t, 2>> corners() const = 0;
  /// May be empty.
  virtual std::string name() const { return {}; }
};

/// A curve of straight pieces.
class PolylineCurve final : public Curve {
 public:
  /// points: at least two, consecutive ones distinct and finite; a closed curve ends where it starts. corners: as
  /// corners() gives them; none for a closed curve. Throws Error (usage.curve).
  PolylineCurve(std::vector<Point> points, std::vector<Region> regions,
                std::optional<std::array<std::size_t, 2>> corners, std::string name = {});

  double length_mm() const override { return along_mm_.back(); }
  Point at(double along_mm) const override;
  Nearest nearest(const Point& p) const override;
  std::vector<Region> regions() const override { return regions_; }
  std::optional<std::array<std::size_t, 2>> corners() const override { return corners_; }
  std::string name() const override { return name_; }

  /// As they were given.
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
