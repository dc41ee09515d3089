// The worst elements of a mesh. Private to quality/.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scantet/quality/quality.h"

namespace scantet {

/// Keeps the kWorstTets elements of smallest key, in order; earlier tets win ties.
class WorstList {
 public:
  bool wants(double key) const { return kept_.size() < kWorstTets || key < kept_.back().key; }

  /// Of the offers with one `name` the first is kept.
  void offer(double key, std::size_t tet, std::uint64_t name) {
    if (!wants(key)) return;
    for (const Entry& entry : kept_) {
      if (entry.name == name) return;
    }
    const auto after =
        std::upper_bound(kept_.begin(), kept_.end(), key, [](double k, const Entry& entry) { return k < entry.key; });
    kept_.insert(after, {key, tet, name});
    if (kept_.size() > kWorstTets) kept_.pop_back();
  }

  /// Adds what a list of later tets has kept.
  void merge(const WorstList& later) {
    for (const Entry& entry : later.kept_) offer(entry.key, entry.tet, entry.name);
  }

  /// Without their places.
  std::vector<WorstTet> take() const {
    std::vector<WorstTet> tets;
    for (const Entry& entry : kept_) tets.push_back({static_cast<std::uint32_t>(entry.tet), {}, entry.key});
    return tets;
  }

  /// With their middles. sign: what makes a value of a key.
  std::vector<WorstTet> take(const TetMesh& mesh, double sign) const {
    std::vector<WorstTet> tets = take();
    for (WorstTet& worst : tets) {
      Point sum;
      for (const VertexId v : mesh.tets[worst.tet]) sum = sum + mesh.vertices[v];
      worst.place = 0.25 * sum;
      worst.value *= sign;
    }
    return tets;
  }

 private:
  struct Entry {
    double key;
    std::size_t tet;
    std::uint64_t name;
  };
  std::vector<Entry> kept_;
};

}  // namespace scantet
