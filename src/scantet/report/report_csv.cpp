// One row a bin, all histograms below each other, as spreadsheets and data frames like it.
#include "scantet/report/chart_impl.h"
#include "scantet/report/measures_impl.h"
#include "scantet/report/report_forms.h"

namespace scantet {
namespace {

// mesh: what the row starts with.
void append(std::string& csv, const std::string& mesh, const char* measure, const Histogram& histogram) {
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    csv += mesh + measure;
    for (const double edge : {histogram.edges[i], histogram.edges[i + 1]}) csv += ',' + number_text(edge);
    csv += ',' + std::to_string(histogram.counts[i]) + '\n';
  }
}

// RFC 4180: quotes around a field, doubled inside.
std::string quoted(const std::string& field) {
  std::string text = "\"";
  for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace

std::string csv_report(std::span<const Report> reports) {
  const bool several = reports.size() > 1;
  const std::vector<std::string> names = mesh_names(reports);
  std::string csv = several ? "mesh,measure,bin_low,bin_high,count\n" : "measure,bin_low,bin_high,count\n";
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (!reports[i].quality) continue;
    for (const ReportMeasure& measure : report_measures()) {
      const Distribution* const distribution = measure.distribution(*reports[i].quality);
      if (distribution == nullptr) continue;
      append(csv, several ? quoted(names[i]) + ',' : "", measure.key, distribution->histogram);
    }
  }
  return csv;
}

}  // namespace scantet
