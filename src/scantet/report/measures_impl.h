// The measures whose distributions and worst tets reports show, declared once: JSON, CSV, charts, text and page all
// walk these tables.
#pragma once

#include <optional>
#include <span>

#include "scantet/quality/quality.h"

namespace scantet {

/// How a measure is drawn.
struct MeasureAxis {
  const char* title;           ///< of its panel
  const char* label;           ///< of its axis, with the unit
  const char* unit;            ///< after a value: "°", " mm"; empty for a ratio
  const char* density;         ///< of the other axis: what makes the area 1
  double low;                  ///< where the axis starts
  std::optional<double> high;  ///< where it ends; none: at the largest value
  bool open_ended;             ///< the histogram's last bin holds all above: it is drawn as wide as the others
  double tick_step;            ///< 0: round numbers, about six
};

struct ReportMeasure {
  const char* key;                                             ///< in JSON and CSV
  const Distribution* (*distribution)(const QualitySummary&);  ///< returns null if it was not measured
  std::optional<MeasureAxis> axis;                             ///< none: not drawn
};

/// In the order in which reports list them.
std::span<const ReportMeasure> report_measures();

/// A list of worst tets.
struct ReportWorst {
  const char* key;  ///< in JSON
  const char* title;
  const char* unit;  ///< after a value, as in MeasureAxis
  std::vector<WorstTet> QualitySummary::*tets;
};

/// In the order in which reports list them.
std::span<const ReportWorst> report_worst_lists();

}  // namespace scantet
