// Where something is wrong with a mesh, and which sizes have been tried there.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// What is wrong with a mesh. World mm.
struct MeshFaults {
  std::vector<Point> losses;         ///< where it is not like the domain
  std::vector<FinerPlace> elements;  ///< those out of bounds, and the size that they have already
  std::vector<Point> handles{};      ///< where handles may be wrong: most of these places are harmless
  /// Of the size at a fault, from 0 to 1: elements that are smaller count as this, as next to what is tiny all would
  /// become so.
  double least_own = 0.5;
};

/// Faults that are nearer to each other than twice the size asked for, from one to the next, are one spot: they have
/// one cause. At each spot the size is halved where its faults are, or where elements are smaller than it already, made
/// half of theirs, again and again, until they are gone. Where that more than doubles the least there was, twice in a
/// row, or makes far more of it, two other sizes are tried; then the spot gets what left the fewest: where two curves
/// are closer than any element, elements only multiply. If more is left of it later, as other spots have changed, it is
/// taken on anew from there.
class TroubleSpots {
 public:
  /// size: that was asked for; not null.
  explicit TroubleSpots(std::shared_ptr<const SizingField> size) : size_(std::move(size)) {}

  /// Where the size is to be finer; nowhere at first.
  std::vector<FinerPlace> places() const;

  /// Of these, those at spots where the last mesh that was judged had no fault.
  std::vector<FinerPlace> places_without_faults() const;

  /// Takes what is wrong with the mesh that was made with places(). Return: how many spots have a
  /// fault, but for those of handles alone.
  std::size_t judge(const MeshFaults& faults);

  /// What is left if each spot gets what was best there.
  struct Outlook {
    std::size_t spots = 0;
    std::size_t faults = 0;  ///< of these
    friend auto operator<=>(const Outlook&, const Outlook&) = default;
  };
  Outlook outlook() const;

  /// Chooses what is tried next, once after each judge(). is_last: nothing new is; each spot gets what was best.
  /// Return: whether places() are others now.
  bool choose(bool is_last);

 private:
  struct Count {
    std::size_t losses = 0;
    std::size_t elements = 0;
    friend auto operator<=>(const Count&, const Count&) = default;
  };
  /// A size that was tried, and what it left.
  struct Try {
    std::vector<FinerPlace> places;
    std::vector<FinerPlace> faults;  ///< as MeshFaults::elements; of losses the size is infinite
    Count count;
  };
  struct Spot {
    Try now;
    std::optional<Try> first;
    Try best;
    bool is_better = false;   // now than before
    int in_vain = 0;          // halvings in a row that made far more of it
    std::size_t retries = 0;  // other sizes tried
  };
  std::vector<std::uint32_t> spots_of(const std::vector<Point>& faults);
  void halve(const SizingField& size, Try& now) const;
  bool choose(Spot& spot, const SizingField& size, bool is_last) const;

  std::shared_ptr<const SizingField> size_;
  std::vector<Spot> spots_;
  std::vector<Point> seen_;             // all faults so far
  std::vector<std::uint32_t> spot_of_;  // each
  double least_own_ = 0.5;              // as judge() was told last
};

}  // namespace scantet
