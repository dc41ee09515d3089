// A column of labels, then wrapped text; below it two histograms and what is wrong. Widths count characters of UTF-8,
// all of which take one column here.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "scantet/report/distances_impl.h"
#include "scantet/report/handles_impl.h"
#include "scantet/report/measures_impl.h"
#include "scantet/report/numbers_impl.h"
#include "scantet/report/region_rows_impl.h"
#include "scantet/report/report_forms.h"
#include "scantet/report/report_times_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kLabelWidth = 11;
constexpr std::size_t kMostListed = 5;  // regions, missing components

bool starts_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
}

std::size_t columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

std::string padded_left(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, columns(text)), ' ') + text;
}

std::string padded_right(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, columns(text)), ' ');
}

// "1 component of 2"
std::string of_expected(std::uint64_t count, const char* one, const char* many, std::optional<std::uint64_t> expected) {
  const std::string text = counted(count, one, many);
  return expected && *expected != count ? text + " (the input has " + grouped(*expected) + ")" : text;
}

class TextReport {
 public:
  TextReport(const Report& report, const TextStyle& style)
      : report_(report),
        width_(static_cast<std::size_t>(std::max(style.width, 40))),
        unicode_(style.unicode),
        degrees_(unicode_ ? "°" : " deg"),
        square_mm_(unicode_ ? " mm²" : " mm2"),
        cubic_mm_(unicode_ ? " mm³" : " mm3"),
        microseconds_(unicode_ ? " µs" : " us") {}

  std::string run() {
    if (report_.mesh) mesh(*report_.mesh);
    if (report_.quality) quality(*report_.quality);
    if (lists_regions()) regions(report_.regions);
    if (report_.audit && report_.audit->complete) topology(*report_.audit);
    if (report_.distance) distances(*report_.distance);
    if (report_.certificate) certificate(*report_.certificate);
    if (report_.components) dropped(*report_.components);
    if (report_.rules) rules(*report_.rules);
    if (report_.optimization) optimization(*report_.optimization);
    if (!report_.bounds.empty()) bounds(report_.bounds);
    if (report_.short_edges && report_.short_edges->count > 0) row("edges", short_edges_text(*report_.short_edges));
    if (report_.timing_s) row("time", text_of(*report_.timing_s));
    if (!report_.stages.empty()) row("stages", text_of(report_.stages));
    if (!report_.phases.empty()) row("phases", text_of(report_.phases));
    if (report_.quality && report_.quality->dihedral_deg.count > 0) histograms(*report_.quality);
    ending();
    return std::move(text_);
  }

 private:
  // A paragraph: words wrapped to the width, lines after the first indented to `indent`.
  void paragraph(const std::string& head, std::size_t indent, const std::string& body) {
    std::string line = head;
    bool empty = true;
    for (std::size_t begin = 0; begin < body.size();) {
      const std::size_t end = std::min(body.find(' ', begin), body.size());
      const std::string word = body.substr(begin, end - begin);
      begin = end + 1;
      if (word.empty()) continue;
      if (!empty && columns(line) + 1 + columns(word) > width_) {
        text_ += line + '\n';
        line.assign(indent, ' ');
        empty = true;
      }
      line += (empty ? "" : " ") + word;
      empty = false;
    }
    text_ += line + '\n';
  }

  void row(const std::string& label, const std::string& body) {
    paragraph(padded_right(label, kLabelWidth), kLabelWidth, body);
  }

  std::string place(const Point& p) const {
    const std::string x = number(p.x);
    return "(" + x + ", " + number(p.y) + ", " + number(p.z) + ") mm";
  }

  void mesh(const ReportMesh& m) {
    row("mesh", counted(m.vertices, "vertex", "vertices") + " (" + grouped(m.boundary_vertices) +
                    " on the boundary), " + counted(m.tets, "tet", "tets") + ", " +
                    counted(m.boundary_facets, "boundary facet", "boundary facets"));
    row("volume", number(m.volume_mm3) + cubic_mm_);
  }

  void quality(const QualitySummary& q) {
    const std::uint64_t tets = q.inverse_aspect.count;
    const std::uint64_t under_10 = q.tets_under_deg[1];
    row("angles", "dihedral " + number(q.min_dihedral_deg()) + degrees_ + " to " + number(q.max_dihedral_deg()) +
                      degrees_ + ", " + counted(under_10, "tet", "tets") + " under 10" + degrees_ + " (" +
                      percent_text(under_10, tets) + "); boundary facets from " + number(q.min_facet_angle_deg) +
                      degrees_ + " on");
    row("shape", "radius-edge ratio up to " + number(q.max_radius_edge()) + ", inverse aspect ratio " +
                     number(q.inverse_aspect.min) + " to " + number(q.inverse_aspect.max) + " (mean " +
                     number(q.inverse_aspect.mean) + "), scaled Jacobian from " + number(q.scaled_jacobian.min) +
                     " (mean " + number(q.scaled_jacobian.mean) + ")");
    const std::string share =
        q.edge_size_ratio ? " (from " + number(q.edge_size_ratio->min) + " of the size asked for there)" : "";
    row("size", "edges " + number(q.edge_length_mm.min) + " to " + number(q.edge_length_mm.max) + " mm" + share +
                    ", circumradius up to " + number(q.max_circumradius_mm()) + " mm, least height " +
                    number(q.min_height_mm.min) + " mm, volumes from " + number(q.volume_mm3.min) + cubic_mm_ +
                    " (median " + number(q.median_volume_mm3()) + cubic_mm_ + ")");
    row("solvers", "explicit: stable time step up to " + number(q.stable_time_step_us.min) + microseconds_ + " at " +
                       number(q.wave_speed_m_per_s) + " m/s; iterative: the condition number up to " +
                       number(q.condition_factor) +
                       " times that of regular tets of the median volume, by shape alone " +
                       number(q.stiffness_ratio.max) + " times");
    worst(q);
  }

  // The worst tet of each list.
  void worst(const QualitySummary& q) {
    const char* label = "worst";
    for (const ReportWorst& list : report_worst_lists()) {
      const std::vector<WorstTet>& tets = q.*list.tets;
      if (tets.empty()) continue;
      const WorstTet& t = tets.front();
      const std::string unit = list.unit == std::string("°")      ? degrees_
                               : list.unit == std::string(" mm³") ? cubic_mm_
                                                                  : list.unit;
      row(label, std::string(list.title) + " " + number(t.value) + unit + ": tet " + std::to_string(t.tet) + " at " +
                     place(t.place));
      label = "";
    }
  }

  bool lists_regions() const {
    const std::vector<ReportRegion>& regions = report_.regions;
    return regions.size() > 1 || std::any_of(regions.begin(), regions.end(), [](const auto& r) { return r.grid; });
  }

  void regions(const std::vector<ReportRegion>& regions) {
    const char* label = "regions";
    for (const std::string& text : region_rows(regions, {degrees_, square_mm_, cubic_mm_})) {
      row(label, text);
      label = "";
    }
    if (const std::string text = voxel_row(regions); !text.empty()) row("voxels", text);
  }

  void topology(const AuditReport& a) {
    std::optional<std::uint64_t> components;
    std::optional<std::uint64_t> cavities;
    if (a.ledger) {
      components = a.ledger->expected_components;
      cavities = a.ledger->expected_cavities;
    }
    const std::string bad = "not manifold at " + counted(a.non_manifold_edges, "edge", "edges") + " and " +
                            counted(a.non_manifold_vertices, "vertex", "vertices");
    row("topology", of_expected(a.components.size(), "component", "components", components) + ", " +
                        of_expected(a.cavities, "cavity", "cavities", cavities) + ", " +
                        counted(a.boundary_components, "boundary surface", "boundary surfaces") + ", Euler number " +
                        std::to_string(a.boundary_euler) + handles(a) + ", " + (a.manifold() ? "manifold" : bad));
    if (a.interfaces.size() > 1) interfaces(a.interfaces);
    if (!has_domain(a)) return;
    if (!knows_parts(a)) row("components", "not checked, nor cavities, for the input does not know how many it has");
    handle_check(a.handle_ledger);
  }

  void handle_check(const std::optional<HandleLedger>& ledger) {
    if (!ledger) return row("handles", "not checked, for the input does not know how many it has");
    const HandleLedger& l = *ledger;
    std::string components = counted(l.compared, "component", "components");
    if (l.compared_cavities > 0) components += " and " + counted(l.compared_cavities, "cavity", "cavities");
    std::string body =
        l.different.empty()
            ? "the input's, in " + std::string(l.compared + l.compared_cavities == 1 ? "" : "each of ") + components
            : "not the input's in " + grouped(l.different.size()) + " of " + components;
    if (!l.different.empty() && l.expected_handles) {
      body += ": " + std::to_string(l.handles) + " of " + std::to_string(*l.expected_handles);
    }
    body += "; Euler number of the boundary " + std::to_string(l.euler) + ", in the input " +
            std::to_string(l.expected_euler);
    if (l.unknown > 0) body += "; not known of " + counted(l.unknown, "component", "components") + " of the input";
    row("handles", body);
  }

  static std::string handles(const AuditReport& a) {
    const std::optional<std::int64_t> count = handles_of(a);
    if (!count) return "";
    return " (" + (*count == 0 ? "no handles" : counted(static_cast<std::uint64_t>(*count), "handle", "handles")) + ")";
  }

  void distances(const BoundaryDistance& d) {
    const auto body = [&](const char* way, const OneWayDistance& one) {
      const std::string text = std::string(way) + ": " + distance_text(one);
      return one.worst.empty() ? text : text + ", the farthest found at " + place(one.worst.front().point);
    };
    row("distance", body("surface to mesh", d.to_mesh));
    row("", body("mesh to surface", d.to_domain));
  }

  void certificate(const ReportCertificate& c) {
    const char* label = "proved";
    for (std::size_t n = 0; n < c.proved.certificates.size(); ++n) {
      const bool several = c.proved.certificates.size() > 1;
      row(label, (several ? "level " + number(c.proved.levels[n]) + ": " : "") +
                     certificate_summary(c.proved.certificates[n]));
      label = "";
    }
    if (c.points_added) row("", counted(*c.points_added, "more vertex", "more vertices") + " for it");
  }

  void dropped(const DroppedComponents& c) {
    std::string body = c.components.empty() ? "none" : grouped(c.components.size());
    body += " of " + counted(c.found, "component", "components") + of_regions(c.components);
    if (!c.components.empty()) {
      body += ", the largest of them " + number(c.components.front().volume_mm3) + cubic_mm_ + " at " +
              place(c.components.front().witness) + ", together " + number(c.volume_mm3()) + cubic_mm_;
    }
    row("dropped", body);
  }

  // " (57 of region 1, 168 of region 2)"; nothing if all are of region 1.
  static std::string of_regions(const std::vector<Component>& dropped) {
    std::map<Region, std::uint64_t> counts;
    for (const Component& component : dropped) ++counts[component.region];
    if (counts.empty() || counts.rbegin()->first == 1) return "";
    std::string text;
    for (const auto& [region, count] : counts) {
      text += (text.empty() ? " (" : ", ") + grouped(count) + " of region " + std::to_string(region);
    }
    return text + ")";
  }

  void interfaces(const std::vector<MeshInterface>& interfaces) {
    std::string body;
    for (std::size_t i = 0; i < std::min(interfaces.size(), kMostListed); ++i) {
      const MeshInterface& f = interfaces[i];
      body += (i == 0 ? "" : "; ") + std::to_string(f.regions[0]) + "/" + std::to_string(f.regions[1]) + ": " +
              counted(f.facets, "facet", "facets") + ", " + counted(f.surfaces, "surface", "surfaces") + ", " +
              number(f.area_mm2) + square_mm_ + ", angles from " + number(f.min_angle_deg) + degrees_ +
              ", Euler number " + std::to_string(f.euler);
    }
    if (interfaces.size() > kMostListed) body += "; and " + grouped(interfaces.size() - kMostListed) + " more";
    row("interfaces", body);
  }

  void rules(const RefinementCounts& r) {
    const std::string repair = r.repair_points == 0 ? "" : ", by topology repair " + grouped(r.repair_points);
    const std::string lattice = r.lattice_points == 0 ? "" : " and " + grouped(r.lattice_points) + " of a lattice";
    row("rules", grouped(r.initial_points) + " initial points" + lattice + "; inserted by R1 " +
                     grouped(r.inserted.r1) + ", R2 " + grouped(r.inserted.r2) + ", R3.1 " + grouped(r.inserted.r3_1) +
                     ", R3.2 " + grouped(r.inserted.r3_2) + repair);
  }

  void optimization(const ReportOptimization& o) {
    std::string text;
    for (const OptimizerStage& s : o.stages) {
      text += (text.empty() ? "" : "; ") + s.stage + ": " + counted(s.changes, "change", "changes") +
              ", smallest dihedral angle from " + printed(s.min_dihedral_before_deg, std::chars_format::fixed, 2) +
              degrees_ + " to " + printed(s.min_dihedral_after_deg, std::chars_format::fixed, 2) + degrees_;
    }
    if (text.empty()) text = "nothing to do";
    if (o.finer_places > 0) text += "; meshed finer at " + counted(o.finer_places, "place", "places");
    row("improved", text);
  }

  // The bounds that hold in one line, each that does not in one of its own.
  void bounds(const std::vector<ReportBound>& bounds) {
    std::string held;
    for (const ReportBound& b : bounds) {
      const std::string asked = b.what + (b.is_least ? " >= " : " <= ") + number(b.asked);
      if (b.broken == 0) held += (held.empty() ? "" : ", ") + asked;
    }
    const bool all = std::none_of(bounds.begin(), bounds.end(), [](const ReportBound& b) { return b.broken > 0; });
    row("bounds", (all ? "all met: " : "met: ") + (held.empty() ? "none" : held));
    for (const ReportBound& b : bounds) {
      if (b.broken > 0) row("", "unmet: " + broken_text(b));
    }
  }

  void histograms(const QualitySummary& q) {
    constexpr std::size_t kDihedralMerge = 3;  // 15 degrees a row
    constexpr std::size_t kAspectMerge = 4;    // 1/30 a row
    histogram("dihedral angles, degrees", q.dihedral_deg.histogram, kDihedralMerge);
    histogram("inverse aspect ratio, inradius / circumradius", q.inverse_aspect.histogram, kAspectMerge);
    constexpr std::size_t kMerge = 4;  // a tenth of the range a row
    if (q.edge_size_ratio) histogram("edge length / size asked for", q.edge_size_ratio->histogram, kMerge);
    histogram("least height, mm", q.min_height_mm.histogram, kMerge);
    histogram(unicode_ ? "volume, mm³" : "volume, mm3", q.volume_mm3.histogram, kMerge);
  }

  // merge: bins in one row.
  void histogram(const char* title, const Histogram& h, std::size_t merge) {
    std::vector<std::uint64_t> counts((h.counts.size() + merge - 1) / merge, 0);
    for (std::size_t i = 0; i < h.counts.size(); ++i) counts[i / merge] += h.counts[i];
    const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    const std::uint64_t largest = std::max<std::uint64_t>(*std::max_element(counts.begin(), counts.end()), 1);
    std::vector<std::string> edges;
    std::size_t edge_width = 0;
    for (std::size_t i = 0; i <= counts.size(); ++i) {
      edges.push_back(number(h.edges[std::min(i * merge, h.counts.size())]));
      edge_width = std::max(edge_width, edges.back().size());
    }
    const std::size_t count_width = grouped(largest).size();
    constexpr std::size_t kPercentWidth = 9;
    const std::size_t fixed = 2 + edge_width + 3 + edge_width + 2 + 1 + count_width + kPercentWidth;
    const std::size_t bar_width = width_ > fixed ? width_ - fixed : 0;
    text_ += '\n';
    paragraph("  ", 2, title);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      text_ += "  " + padded_left(edges[i], edge_width) + (unicode_ ? " – " : " - ") +
               padded_left(edges[i + 1], edge_width) + "  " +
               padded_right(bar(static_cast<double>(counts[i]) / static_cast<double>(largest), bar_width), bar_width) +
               " " + padded_left(grouped(counts[i]), count_width) +
               padded_left(percent_text(counts[i], total), kPercentWidth) + '\n';
    }
  }

  // Anything above zero shows.
  std::string bar(double share, std::size_t width) const {
    static constexpr const char* kEighths[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
    const double length = share * static_cast<double>(width);
    std::string text;
    if (!unicode_) return std::string(static_cast<std::size_t>(std::ceil(length)), '#');
    const auto eighths = static_cast<std::size_t>(std::ceil(8 * length));
    for (std::size_t i = 0; i < eighths / 8; ++i) text += "█";
    return text + kEighths[eighths % 8];
  }

  // What needs attention comes last, where the eye is.
  void ending() {
    const std::size_t before = text_.size();
    if (report_.limit) {
      row("limit", "stopped at the largest number of vertices; " + report_.limit->rule +
                       " kept inserting points, the last at " + place(report_.limit->place) + ", " +
                       number(report_.limit->insertion_radius_mm) + " mm from its nearest vertex");
    }
    if (report_.audit) audit(*report_.audit);
    if (before > 0 && text_.size() > before) text_.insert(before, 1, '\n');
  }

  void audit(const AuditReport& a) {
    if (a.passed()) {
      row("audit", "passed");
      return;
    }
    row("audit", counted(a.findings.size(), "fault", "faults") + ":");
    for (const Finding& f : a.findings) {
      paragraph("  - ", 4, f.message + ", at " + place(f.where) + ". Remedy: " + f.remedy + ". [" + f.code + "]");
    }
    if (!a.complete) row("", "The other checks need these faults repaired first.");
    if (a.ledger) missing(a.ledger->missing);
  }

  void missing(const std::vector<Component>& missing) {
    for (std::size_t i = 0; i < std::min(missing.size(), kMostListed); ++i) {
      const Component& c = missing[i];
      std::string line = std::string(c.region == kOutside ? "cavity" : "component") + " at " + place(c.witness);
      if (c.volume_mm3 > 0) line += ", about " + number(c.volume_mm3) + cubic_mm_;
      row(i == 0 ? "missing" : "", line);
    }
    if (missing.size() > kMostListed) row("", "and " + grouped(missing.size() - kMostListed) + " more");
  }

  const Report& report_;
  std::size_t width_;
  bool unicode_;
  std::string degrees_;
  std::string square_mm_;
  std::string cubic_mm_;
  std::string microseconds_;
  std::string text_;
};

}  // namespace

std::string text_report(const Report& report, const TextStyle& style) {
  return TextReport(report, style).run();
}

}  // namespace scantet
