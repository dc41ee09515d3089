// Reports for the tests of report/.
#pragma once

#include "scantet/report/report.h"
#include "scantet/report/report_forms.h"
#include "unit/io/io_test_support.h"

namespace scantet {

/// A report with every part in it but sizes against a sizing field.
inline Report full_report() {
  const TetMesh mesh = make_cube(4, 1, 2);
  Report report;
  report.version = "1.2.3";
  report.input = ReportInput{"scans/head.nrrd", std::string(64, 'a'),
                             Frame({Vec{0.5, 0, 0}, Vec{0, 0.7, 0}, Vec{0, 0, 1.1}}, {-10, 20, 0.1})};
  report.options = {{"size", 0.1},
                    {"facet-distance", nullptr},
                    {"seeding", "paper"},
                    {"verbose", false},
                    {"max-vertices", std::uint64_t{20000000}},
                    {"output", std::vector<std::string>{"a.vtu", "b.stl"}}};
  report.stop = "limit";
  report.limit = LimitReport{"R3.1", {1.5, -2, 3}, 0.02};
  report.components = DroppedComponents{58, {{1, {4, 5, 6}, Box(), 12.25}, {1, {7, 8, 9}, Box(), 8}}};
  report.quality = measure_quality(mesh);
  report.mesh = report_mesh(mesh, *report.quality);
  report.rules = RefinementCounts{500, 0, 0, 0, {1316, 1225, 90791, 13524}, {0, 2, 7}};
  report.bounds = {
      {"min_dihedral_deg", "dihedral angle, degrees", "--min-dihedral 10", true, 10, 0, 384, {}, {}},
      {"tet_size_ratio", "R3: circumradius / size of tets", "--size", false, 1, 7, 384, 1.00004, Point{1, 2, 3}}};
  report.audit = audit(mesh, nullptr);
  report.audit->ledger = ComponentLedger{3, 1, {{1, {1, 2, 3}, Box{{0, 0, 0}, {2, 3, 4}}, 12.5}}};
  report.audit->findings.push_back({"audit.component_missing",
                                    1,
                                    "components of the domain that the mesh has not: 1",
                                    "mesh with a smaller --size if they matter",
                                    {1, 2, 3}});
  ReportTiming timing;
  timing.read = 0.25;
  timing.refine = 12.5;
  timing.total = 13.75;
  report.timing_s = timing;
  report.notes = {"a note"};
  report.stages = {{"boundary sample", 0.75, 500}, {"classify", 0.25, 0}, {"R3.1", 8.5, 90791}};
  report.phases = {{"read", "input", 0.25, 0.125}, {"audit", "faces", 1.5, 2.75}, {"audit", "boundary", 0.5, 0.5}};
  return report;
}

/// What is known of a mesh alone, under this name.
inline Report plain_report(const TetMesh& mesh, const std::string& path, const SizingField* size = nullptr) {
  Report report;
  report.version = "1.2.3";
  report.input = ReportInput{path, "", std::nullopt};
  report.quality = measure_quality(mesh, size, size);
  report.mesh = report_mesh(mesh, *report.quality);
  report.audit = audit(mesh, nullptr);
  return report;
}

}  // namespace scantet
