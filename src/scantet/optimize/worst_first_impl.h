// Private: the loop that exudation and improvement share: bad tets are changed for the better, the worst first.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/optimize/change_impl.h"
#include "scantet/optimize/element_check_impl.h"

namespace scantet::optimize {

/// Knows what to do about a bad tet. Reads the complex only; keeps its buffers from one tet to the next.
class Remedy {
 public:
  virtual ~Remedy() = default;
  /// Looks for a change that makes t, or what comes in its place, less sharp than best.sharpest.
  virtual void find(TetId t, Change& best) = 0;
};

/// What is done about bad tets.
struct Treatment {
  std::string_view doing;                                ///< for progress
  std::function<std::unique_ptr<Remedy>()> make_remedy;  ///< called for each thread's share of the work
  std::function<void(const Change&)> made = {};          ///< told of each change, in their order; may be empty
  /// Whether changes may move vertices or add some. Then a change must make things less sharp by some least step, and
  /// what is beyond help is given up: else small gains would go on for very long. Without new places for vertices there
  /// are only so many tets, and any gain will do.
  bool moves_vertices = true;
};

struct WorstFirstResult {
  std::uint64_t changes = 0;  ///< how many were made
  std::vector<TetId> left;    ///< tets that no remedy was found for
};

/// Makes one change; a new vertex gets its number in it. Returns the slots of the tets that have come, as replace()
/// does.
std::span<const TetId> make_change(TetComplex& complex, Change& change);

/// Makes changes until none of the tets given, and none that comes in their place, is sharper than the bound of the
/// complex's judge or has a face on the boundary that is, or no remedy is found for those that are.
///
/// Tets are taken in rounds, the worst first. The changes of a round are found side by side, then made in order, each
/// unless one made before it has touched what it was found from. Tets without remedy are tried again when there are
/// other tets at their vertices; where vertices move, until that leaves hardly fewer of them than the time before.
/// Cancelled: what is done stays. Guarantees: a change leaves no element as sharp as the one that it was found for;
/// does not depend on the number of threads.
WorstFirstResult change_worst_first(TetComplex& complex, const ElementCheck& check, const std::vector<TetId>& first,
                                    const Treatment& treatment, Progress& progress);

}  // namespace scantet::optimize
