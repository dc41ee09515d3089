// One row a bin, all histograms below each other, as spreadsheets and data frames like it.
#include "scantet/io/report.h"

namespace scantet {
namespace {

void append(std::string& csv, const char* measure, const Histogram& histogram) {
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    csv += measure;
    for (const double edge : {histogram.edges[i], histogram.edges[i + 1]}) csv += ',' + number_text(edge);
    csv += ',' + std::to_string(histogram.counts[i]) + '\n';
  }
}

}  // namespace

std::string csv_report(const Report& report) {
  std::string csv = "measure,bin_low,bin_high,count\n";
  if (!report.quality) return csv;
  const QualitySummary& q = *report.quality;
  append(csv, "inverse_aspect", q.inverse_aspect.histogram);
  append(csv, "dihedral_deg", q.dihedral_deg.histogram);
  append(csv, "radius_edge", q.radius_edge.histogram);
  append(csv, "edge_length_mm", q.edge_length_mm.histogram);
  append(csv, "circumradius_mm", q.circumradius_mm.histogram);
  append(csv, "volume_mm3", q.volume_mm3.histogram);
  return csv;
}

}  // namespace scantet
