// How fast a domain answers the oracle's two questions.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::bench {

inline void ask_regions(benchmark::State& state, const Domain& domain, const std::vector<Point>& points) {
  for (auto _ : state) {
    std::int64_t inside = 0;
    for (const Point& p : points) inside += domain.region_at(p);
    benchmark::DoNotOptimize(inside);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}

inline void ask_crossings(benchmark::State& state, const Domain& domain, const std::vector<Segment>& edges) {
  Crossings crossings;
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (const Segment& edge : edges) {
      domain.crossings(edge, crossings);
      found += crossings.size();
    }
    benchmark::DoNotOptimize(found);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(edges.size()));
  state.counters["crossings"] = static_cast<double>(found);
}

}  // namespace scantet::bench
