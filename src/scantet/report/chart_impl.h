// Histograms ready to be drawn: panels of curves, one a mesh, each of area 1 so that meshes of any size compare.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "scantet/report/report.h"

namespace scantet {

/// One mesh's histogram of one measure, as a step curve.
struct ChartCurve {
  std::size_t mesh;             ///< index of the report
  std::vector<double> edges;    ///< ascending, one more than density
  std::vector<double> density;  ///< share of the values in a bin over its width: the area under the curve is 1
  double min;                   ///< smallest and largest value, the latter may be infinite
  double max;
};

struct ChartPanel {
  std::string title;
  std::string label;          ///< of the axis
  std::string unit;           ///< after a value
  std::string density_label;  ///< of the upright axis
  double low;                 ///< the axis runs from low to high
  double high;
  double highest;             ///< density
  bool open_ended;            ///< the last bin of each curve holds all above
  std::vector<double> ticks;  ///< round numbers in [low, high]
  std::vector<ChartCurve> curves;
};

/// One panel for each measure that a report has values of.
std::vector<ChartPanel> chart_panels(std::span<const Report> reports);

/// Round numbers in [low, high], `step` apart; step 0: about `count` of them, 1, 2 or 5 times a power of ten apart.
std::vector<double> round_ticks(double low, double high, double step, int count);

inline constexpr std::size_t kMeshColors = 7;

/// "#0072b2": a colour for each mesh, told apart by every kind of colour vision; they come round after kMeshColors.
std::string mesh_color(std::size_t mesh);

/// The shortest names that tell the meshes apart: of the files, else their paths, numbered if the same again. UTF-8.
std::vector<std::string> mesh_names(std::span<const Report> reports);

/// The panels as an SVG image, and as a PNG image of twice the points. Need no display. The same bytes for the same
/// reports and fonts. Throws Error (internal.chart) if the drawing library fails.
void write_svg(std::ostream& out, std::span<const Report> reports);
void write_png(std::ostream& out, std::span<const Report> reports);

}  // namespace scantet
