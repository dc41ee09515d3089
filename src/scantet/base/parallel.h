// Loops on several threads whose result does not depend on how many there are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"
#include "scantet/base/progress.h"

namespace SCANTET_API scantet {

/// Runs `work` with at most `threads` threads (0: as many as the machine has cores; more than 256 count as 256) for all
/// parallel loops in it. Until it ends, other loops of oneTBB in the process get no more threads than that, either.
/// What `work` throws is thrown here.
void with_threads(std::size_t threads, const std::function<void()>& work);

/// Threads that a parallel loop started here may use; at least 1.
int thread_count();

/// Calls body(begin, end) for the pieces of [0, count) that are `grain` long (the last may be shorter), on several
/// threads, in any order. Waits for all; an exception of one is thrown here, and then some may not have been begun.
/// Pre: grain ≥ 1. Guarantees: the pieces do not depend on the number of threads.
void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

/// Runs `work`. Once progress is cancelled, the parallel loops that it has started on this thread end early, and so
/// does the work itself, by an exception that does not leave this function; others do. progress: cancelled() is called
/// before each piece, from several threads at once. Return: whether the work ran to its end and progress is still not
/// cancelled.
bool run_interruptible(const Progress& progress, const std::function<void()>& work);

/// Joins what body(begin, end, out) adds to `out`, an empty std::vector<T>, for the pieces of [0, count), piece after
/// piece, in their order. Pieces, threads, exceptions and Pre: as of parallel_for().
template <class T, class Body>
std::vector<T> parallel_collect(std::size_t count, std::size_t grain, const Body& body) {
  std::vector<std::vector<T>> pieces((count + grain - 1) / grain);
  parallel_for(count, grain, [&](std::size_t begin, std::size_t end) { body(begin, end, pieces[begin / grain]); });
  std::size_t total = 0;
  for (const std::vector<T>& piece : pieces) total += piece.size();
  std::vector<T> all;
  all.reserve(total);
  for (const std::vector<T>& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

/// The box around point_of(0), …, point_of(count - 1), which is called from several threads; empty if count is 0.
template <class PointOf>
Box parallel_bounds(std::size_t count, const PointOf& point_of) {
  constexpr std::size_t kPiece = 8192;
  std::vector<Box> pieces((count + kPiece - 1) / kPiece);
  parallel_for(count, kPiece, [&](std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) box.extend(point_of(i));
    pieces[begin / kPiece] = box;
  });
  Box all;
  for (const Box& box : pieces) all.unite(box);
  return all;
}

/// Sorts by a total order: pieces side by side, then merged in pairs. values: of random access. less: called from
/// several threads.
template <class Vector, class Less>
void parallel_sort(Vector& values, Less less) {
  constexpr std::size_t kPiece = 16384;
  const auto at = [&](std::size_t i) {
    return values.begin() + static_cast<std::ptrdiff_t>(std::min(i, values.size()));
  };
  parallel_for(values.size(), kPiece, [&](std::size_t begin, std::size_t end) { std::sort(at(begin), at(end), less); });
  for (std::size_t width = kPiece; width < values.size(); width *= 2) {
    parallel_for((values.size() + 2 * width - 1) / (2 * width), 1, [&](std::size_t pair, std::size_t) {
      std::inplace_merge(at(2 * pair * width), at((2 * pair + 1) * width), at((2 * pair + 2) * width), less);
    });
  }
}

}  // namespace scantet
