// Pieces of the curves where three or more regions meet, traced through the cells of a label field.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/labels/label_field.h"

namespace scantet {

/// A point where a piece ends: three regions meet there in a face of the tracing's tets, or four in a tet.
struct PieceEnd {
  static constexpr Region kNone = -1;

  std::int64_t place = 0;           ///< names the face or the tet, among those of its kind
  std::array<Region, 4> regions{};  ///< ascending; the last is kNone in a face
  Vec index;                        ///< where it is, voxel units

  /// Equal ones are the same point, whichever piece they end.
  friend bool operator==(const PieceEnd& a, const PieceEnd& b) { return a.place == b.place && a.regions == b.regions; }
  friend bool operator<(const PieceEnd& a, const PieceEnd& b) {
    return a.place != b.place ? a.place < b.place : a.regions < b.regions;
  }
};

/// A straight piece along which three regions meet.
struct JunctionPiece {
  std::array<Region, 3> regions;  ///< ascending
  std::array<PieceEnd, 2> ends;
};

/// All pieces, in the order of the cells.
struct JunctionPieces {
  std::vector<JunctionPiece> pieces;
  std::size_t broken = 0;  ///< pieces left out, as rounding let them have one end or more than two
};

/// Cuts each cell with three labels or more into 8³ subcells and these into six tets each, in which fields are linear.
/// There three regions meet in straight pieces, and what a face shows of them depends on that face alone, so
/// pieces of neighbouring tets join. Ties are broken by a tiny shift of each label's field. If progress is cancelled,
/// some pieces are missing.
JunctionPieces trace_junctions(const LabelField& field, const Progress& progress);

}  // namespace scantet
