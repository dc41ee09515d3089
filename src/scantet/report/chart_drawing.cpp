// One drawing for both kinds of image: Cairo draws on an SVG or a PNG surface, without a display. Panels of the first
// row may be wider. Text is drawn without hinting, so that it has the same shape and place on either surface.
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <ostream>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/report/chart_impl.h"
#include "scantet/report/numbers_impl.h"

namespace scantet {
namespace {

constexpr double kWidth = 1200;
constexpr double kRowHeight = 310;  // of a row of panels, ranges apart
constexpr double kRangeLine = 16;
constexpr double kMargin = 24;
constexpr double kLegendLine = 22;
constexpr double kTextSize = 12;
constexpr double kTitleSize = 15;
constexpr double kPixelsAPoint = 2;     // of a PNG image
constexpr std::size_t kMostRanges = 8;  // written into a panel

struct Rectangle {
  double x, y, width, height;
};

struct Color {
  double red, green, blue;
};
constexpr Color kInk{0.13, 0.15, 0.19};
constexpr Color kFaint{0.87, 0.89, 0.91};
constexpr Color kGrey{0.38, 0.41, 0.46};

Color color_of(std::size_t mesh) {
  const unsigned long rgb = std::stoul(mesh_color(mesh).substr(1), nullptr, 16);
  const auto part = [&](int shift) { return static_cast<double>((rgb >> shift) & 0xffU) / 255; };
  return {part(16), part(8), part(0)};
}

std::size_t rows_of(std::size_t panels) {
  constexpr std::size_t kInRow = 3;
  return panels > 2 * kInRow ? (panels + kInRow - 1) / kInRow : panels > 2 ? 2 : 1;
}

double legend_height_of(std::size_t meshes) {
  return kMargin + kLegendLine * static_cast<double>(meshes);
}

double ranges_height_of(std::size_t meshes) {
  return kRangeLine * static_cast<double>(std::min(meshes, kMostRanges));
}

double row_height_of(std::size_t meshes) {
  return kRowHeight + ranges_height_of(meshes);
}

double chart_height(std::span<const Report> reports) {
  const auto rows = static_cast<double>(rows_of(chart_panels(reports).size()));
  return legend_height_of(reports.size()) + row_height_of(reports.size()) * rows + kMargin / 2;
}

class ChartDrawing {
 public:
  ChartDrawing(cairo_t* cairo, std::span<const Report> reports)
      : cairo_(cairo), reports_(reports), names_(mesh_names(reports)), panels_(chart_panels(reports)) {
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(cairo_, options);
    cairo_font_options_destroy(options);
  }

  void draw() {
    cairo_set_source_rgb(cairo_, 1, 1, 1);
    cairo_paint(cairo_);
    legend();
    for (std::size_t row = 0; row < rows(); ++row) {
      const std::size_t begin = panels_.size() * row / rows();
      const std::size_t end = panels_.size() * (row + 1) / rows();
      const double width = (kWidth - kMargin) / static_cast<double>(end - begin);
      const double top = legend_height() + row_height() * static_cast<double>(row);
      for (std::size_t i = begin; i < end; ++i) {
        panel(panels_[i], {kMargin / 2 + width * static_cast<double>(i - begin), top, width, row_height()});
      }
    }
  }

 private:
  std::size_t rows() const { return rows_of(panels_.size()); }
  double legend_height() const { return legend_height_of(reports_.size()); }

  double row_height() const { return row_height_of(reports_.size()); }

  void ink(const Color& c, double alpha = 1) { cairo_set_source_rgba(cairo_, c.red, c.green, c.blue, alpha); }

  void font(double size, bool bold) {
    cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, size);
  }

  // align: 0 starts at x, 0.5 is centred there, 1 ends there.
  void text(double x, double y, double align, const std::string& words) {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, words.c_str(), &extents);
    cairo_move_to(cairo_, x - align * extents.x_advance, y);
    cairo_show_text(cairo_, words.c_str());
  }

  void line(double x1, double y1, double x2, double y2) {
    cairo_move_to(cairo_, x1, y1);
    cairo_line_to(cairo_, x2, y2);
    cairo_stroke(cairo_);
  }

  void legend() {
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      const double y = kMargin + kLegendLine * (static_cast<double>(i) + 0.25);
      cairo_rectangle(cairo_, kMargin, y - 10, 22, 11);
      ink(color_of(i), 0.25);
      cairo_fill_preserve(cairo_);
      stroke_as(i);
      ink(kInk);
      font(kTextSize + 1, true);
      text(kMargin + 32, y, 0, shortened(names_[i]));
      ink(kGrey);
      font(kTextSize, false);
      text(kWidth - kMargin, y, 1, facts(reports_[i]));
    }
  }

  static std::string shortened(const std::string& name) {
    constexpr std::size_t kLongest = 80;
    if (name.size() <= kLongest) return name;
    std::size_t begin = name.size() - kLongest;
    while ((static_cast<unsigned char>(name[begin]) & 0xc0U) == 0x80U) ++begin;  // not inside a character
    return "…" + name.substr(begin);
  }

  static std::string facts(const Report& report) {
    if (!report.quality) return "";
    const QualitySummary& q = *report.quality;
    return grouped(q.volume_mm3.count) + " tets, dihedral angles " + number(q.min_dihedral_deg()) + "° to " +
           number(q.max_dihedral_deg()) + "°";
  }

  void panel(const ChartPanel& p, const Rectangle& cell) {
    const double head = 34 + ranges_height_of(reports_.size());
    const Rectangle box{cell.x + 66, cell.y + head, cell.width - 86, cell.height - head - 64};
    ink(kInk);
    font(kTitleSize, true);
    text(box.x, cell.y + 24, 0, p.title);
    axes(p, cell, box);
    cairo_save(cairo_);
    cairo_rectangle(cairo_, box.x, box.y - 2, box.width, box.height + 3);
    cairo_clip(cairo_);
    for (const ChartCurve& c : p.curves) curve(p, c, box);
    cairo_restore(cairo_);
    ranges(p, cell, box);
  }

  static double across(const ChartPanel& p, const Rectangle& box, double value) {
    return box.x + box.width * std::clamp((value - p.low) / (p.high - p.low), 0.0, 1.0);
  }

  static double top_of(const ChartPanel& p) {
    constexpr double kHeadroom = 1.06;
    return p.highest * kHeadroom;
  }

  static double up(const ChartPanel& p, const Rectangle& box, double density) {
    return box.y + box.height * (1 - density / top_of(p));
  }

  void axes(const ChartPanel& p, const Rectangle& cell, const Rectangle& box) {
    font(kTextSize, false);
    cairo_set_line_width(cairo_, 1);
    for (const double tick : round_ticks(0, top_of(p), 0, 4)) {
      const double y = up(p, box, tick);
      ink(kFaint);
      line(box.x, y, box.x + box.width, y);
      ink(kGrey);
      text(box.x - 8, y + 4, 1, number_text(tick, 4));
    }
    const double bottom = box.y + box.height;
    ink(kGrey);
    line(box.x, bottom, box.x + box.width, bottom);
    for (const double tick : p.ticks) {
      const double x = across(p, box, tick);
      line(x, bottom, x, bottom + 5);
      text(x, bottom + 22, 0.5, number_text(tick, 4));
    }
    ink(kInk);
    text(box.x + box.width / 2, bottom + 43, 0.5, p.label + (p.open_ended ? " (last bin: all above)" : ""));
    cairo_save(cairo_);
    cairo_translate(cairo_, cell.x + 14, box.y + box.height / 2);
    cairo_rotate(cairo_, -std::numbers::pi / 2);
    text(0, 0, 0.5, p.density_label);
    cairo_restore(cairo_);
  }

  // The current path, in the line of that mesh. After the palette's colours have come round, lines are dashed.
  void stroke_as(std::size_t mesh) {
    constexpr double kDash = 5;
    ink(color_of(mesh));
    cairo_set_line_width(cairo_, 1.8);
    if (mesh >= kMeshColors) cairo_set_dash(cairo_, &kDash, 1, 0);
    cairo_stroke(cairo_);
    cairo_set_dash(cairo_, nullptr, 0, 0);
  }

  void curve(const ChartPanel& p, const ChartCurve& c, const Rectangle& box) {
    const double bottom = box.y + box.height;
    cairo_move_to(cairo_, across(p, box, c.edges.front()), bottom);
    for (std::size_t i = 0; i < c.density.size(); ++i) {
      const double y = up(p, box, c.density[i]);
      cairo_line_to(cairo_, across(p, box, c.edges[i]), y);
      cairo_line_to(cairo_, across(p, box, c.edges[i + 1]), y);
    }
    cairo_line_to(cairo_, across(p, box, c.edges.back()), bottom);
    ink(color_of(c.mesh), p.curves.size() == 1 ? 0.3 : 0.12);
    cairo_fill_preserve(cairo_);
    stroke_as(c.mesh);
  }

  // Smallest and largest values: marks on the axis, numbers under the title.
  void ranges(const ChartPanel& p, const Rectangle& cell, const Rectangle& box) {
    constexpr double kMark = 5;
    const double bottom = box.y + box.height;
    font(kTextSize, false);
    double y = cell.y + 42;
    for (std::size_t i = 0; i < p.curves.size(); ++i) {
      const ChartCurve& c = p.curves[i];
      ink(color_of(c.mesh));
      for (const double value : {c.min, c.max}) {
        const double x = across(p, box, value);
        cairo_move_to(cairo_, x, bottom);
        cairo_line_to(cairo_, x - kMark, bottom + 2 * kMark - 1);
        cairo_line_to(cairo_, x + kMark, bottom + 2 * kMark - 1);
        cairo_fill(cairo_);
      }
      if (i >= kMostRanges) continue;
      text(box.x, y, 0, "min " + number(c.min) + p.unit + ", max " + number(c.max) + p.unit);
      y += kRangeLine;
    }
  }

  cairo_t* cairo_;
  std::span<const Report> reports_;
  std::vector<std::string> names_;
  std::vector<ChartPanel> panels_;
};

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};
using Surface = std::unique_ptr<cairo_surface_t, Release>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error(Fault::internal, "internal.chart",
              std::string("cannot draw the histograms: ") + cairo_status_to_string(status),
              "write the report as .json or .csv instead");
}

void draw(cairo_surface_t* surface, double scale, std::span<const Report> reports) {
  const std::unique_ptr<cairo_t, Release> cairo(cairo_create(surface));
  cairo_scale(cairo.get(), scale, scale);
  ChartDrawing(cairo.get(), reports).draw();
  require(cairo_status(cairo.get()));
}

// Cairo counts its surfaces through the life of a process: the one thing in which two files would differ.
std::string without_surface_id(std::string svg) {
  const std::string opening = " id=\"surface";
  const std::size_t begin = svg.find(opening);
  if (begin == std::string::npos) return svg;
  return svg.erase(begin, svg.find('"', begin + opening.size()) + 1 - begin);
}

}  // namespace

void write_svg(std::ostream& out, std::span<const Report> reports) {
  std::string bytes;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, kWidth, chart_height(reports)));
  draw(surface.get(), 1, reports);
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  out << without_surface_id(std::move(bytes));
}

void write_png(std::ostream& out, std::span<const Report> reports) {
  std::string bytes;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(kPixelsAPoint * kWidth),
                                                   static_cast<int>(kPixelsAPoint * chart_height(reports))));
  draw(surface.get(), kPixelsAPoint, reports);
  require(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
  out << bytes;
}

}  // namespace scantet
