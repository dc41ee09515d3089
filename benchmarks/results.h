// The runs of a comparison, what follows from them, and the forms they come in: tables and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases.h"
#include "figures.h"

namespace scantet::bench {

/// The contestants' names in options and JSON. _n: on several threads.
inline constexpr const char* kScantetN = "scantet_n";
inline constexpr const char* kScantet1 = "scantet_1";
inline constexpr const char* kCgalN = "cgal_n";
inline constexpr const char* kCgal1 = "cgal_1";
inline constexpr const char* kLimit = "limit";

struct Run {
  std::string contestant;
  int round = 0;
  Figures figures;
  std::string error;  ///< why there are no figures; empty if there are
};

struct CaseResults {
  Case subject;
  std::vector<Run> runs;
};

/// The case's table: medians, sizes, quality and memory of each contestant; ratios; whether the threads agree.
void print_tables(const CaseResults& results, int threads);

/// Seconds and peak bytes a tet of scantet over the sizes of one scan, if several were run.
void print_scaling(const std::vector<CaseResults>& all);

/// The document: command, date, machine, threads, cases[].{name, scan, level, criteria, runs[].{contestant, round,
/// figures or error}, ratios[].{name, of_medians, min, max}, same_mesh}. ratios: min and max over the rounds.
/// same_mesh: scantet_1 and scantet_n always made the same bytes; null if not both ran.
nlohmann::json json_of(const std::vector<CaseResults>& all, const std::string& command, int threads);

}  // namespace scantet::bench
