// Where regions of a label field meet, found from a guess nearby.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "scantet/labels/label_field.h"

namespace scantet {

/// Answers for one thread; remembers the cell it looked at last. Places are in voxel units.
class JunctionPlaces {
 public:
  explicit JunctionPlaces(const LabelField& field) : field_(field) {}

  /// The place near the guess where the fields of these regions (three or more) are equal, and no other field is
  /// larger; nothing if there is none within half a voxel that Newton's steps lead to. A guess on a face between cells
  /// stays in it if that has such a place: curves have kinks there.
  std::optional<Vec> meeting_near(const Vec& guess, std::span<const Region> regions);

  /// For a guess that no meeting is near: where as many of the largest fields as possible are equal, three or two; or
  /// where a line from it, in one of 26 directions, first comes to another region.
  std::optional<Vec> boundary_near(const Vec& guess);

  /// Of three regions that meet along a curve: positive if they follow each other around it in this order, right-handed
  /// about the direction; the larger, the clearer. 0 if not known. place: on the curve.
  double turn_of(const Vec& place, const Vec& direction, std::span<const Region, 3> regions);

  /// The cell that it has looked at last.
  const std::array<int, 3>& cell() const { return at_; }

  /// Of three regions whose curves cross at a place the one that meets itself there; nothing if their fields are not
  /// known there. Around it the others' fields are, to first order, on both sides of its own.
  std::optional<Region> meeting_itself(const Vec& place, std::span<const Region, 3> regions);

  /// The regions on a small circle around the direction, right-handed, from the least one on; places: on the curve.
  std::vector<Region> regions_around(const Vec& place, const Vec& direction);

 private:
  static constexpr int kNowhere = std::numeric_limits<int>::min();

  /// Values and gradients of the regions' fields, those of other regions' as far as the largest goes.
  struct Fields {
    std::vector<double> values;
    std::vector<Vec> gradients;
    double largest_other = -std::numeric_limits<double>::infinity();
  };
  bool evaluate(const Vec& place, std::span<const Region> regions);
  bool evaluate_in(const std::array<int, 3>& cell, const Vec& place, std::span<const Region> regions);
  bool look_at(const std::array<int, 3>& cell);
  std::optional<Vec> newton(const Vec& guess, std::span<const Region> regions, const std::array<bool, 3>& frozen);
  Vec step(const std::array<bool, 3>& frozen) const;
  Region region_at(const Vec& place);
  std::optional<Vec> change_near(const Vec& guess);

  const LabelField& field_;
  std::array<int, 3> at_{kNowhere, kNowhere, kNowhere};
  LabelCell cell_;
  Fields fields_;
};

}  // namespace scantet
