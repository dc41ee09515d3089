// Default values stand in the structs; the texts of options stand here and nowhere else.
#include "scantet/app/mesh_job.h"

#include <algorithm>

#include "scantet/app/field_options.h"
#include "scantet/base/error.h"
#include "scantet/base/quantity.h"

namespace scantet {
namespace {

const char* const kSizes = "Sizes and shapes";
const char* const kRun = "Run";
const char* const kOutput = "Output";

LengthOrShare read_edge_length(const std::string& place, const std::string& text) {
  const LengthOrShare length = read_length_or_share(place, text);
  if (length.share > kMostMinEdgeShare) {
    throw Error(Fault::usage, "usage.value",
                place + ": " + text + " is more than " + number_text(100 * kMostMinEdgeShare) + "% of the size",
                "give less, or a length in mm");
  }
  return length;
}

void declare_sizes(OptionSet& options, MeshJob& job) {
  const std::string unless_not_improved = ", or no bound with --optimize none";
  declare_size_options(options, job.sizes);
  options.add("alpha", job.mesher.bounds.alpha, Range::above(0),
              {kSizes, "X", "a factor",
               "Surface balls may have this many times the size as radius: smaller means a finer surface."});
  options.add("facet-radius-edge", job.mesher.bounds.facet_radius_edge, Range::at_least(0.6),
              {kSizes, "X", "a radius-edge ratio",
               "Largest circumradius / shortest edge of a boundary triangle; 1 means no angle under 30 degrees (R1), "
               "but see --small-slack. Refinement ends from 1 on; below that refinement may run into --max-vertices."});
  options.add(
      "cell-radius-edge", job.mesher.bounds.cell_radius_edge, Range::at_least(0.7),
      {kSizes, "X", "a radius-edge ratio",
       "Largest circumradius / shortest edge of a tetrahedron. Refinement ends from 2 on in practice; below that "
       "refinement may run into --max-vertices."});
  options.add(
      "small-slack", job.mesher.bounds.small_slack, Range::at_least(1),
      {kSizes, "X", "a factor",
       "Elements of less than half of the size, which features smaller than that need, may have this many times "
       "the two ratios above; 1 for none, which takes up to twice as many vertices and as long on rough scans. "
       "Not where regions meet in curves or edges are sharp. --min-dihedral holds all the same."});
  options.add("min-dihedral", job.min_dihedral_deg, Range::between(0, 60),
              {kSizes, "DEG", "an angle in degrees",
               "Smallest dihedral angle of the mesh. More takes longer: up to 15 degrees hardly, 20 a little.", 0,
               number_text(kMinDihedralDeg) + unless_not_improved});
  options.add("max-dihedral", job.max_dihedral_deg, Range::between(kLeastMaxDihedralDeg, 180),
              {kSizes, "DEG", "an angle in degrees", "Largest dihedral angle of the mesh.", 0,
               number_text(kMaxDihedralDeg) + unless_not_improved});
  options.add("min-scaled-jacobian", job.min_scaled_jacobian, Range::between(0, kMostScaledJacobian),
              {kSizes, "X", "a share of the regular tetrahedron's",
               "Smallest scaled Jacobian of the mesh; 0 is flat, 1 the regular tetrahedron.", 0,
               number_text(kMinScaledJacobian) + unless_not_improved});
  options.add(
      "min-edge", job.min_edge, Range::at_least(0),
      "or a share of the size, up to " + number_text(100 * kMostMinEdgeShare) + "%: 5%",
      [](const OptionValue& value) { read_edge_length(value.place, value.text); },
      {kSizes, "LENGTH", "a length",
       "Least length of edges: in mm, or with % as a share of the size there; 0 for any. Vertices are taken away "
       "where edges are shorter, as far as topology, surface and the other bounds allow. Without the option, "
       "shorter edges that are left are told; with it, they mean exit status 4, and more is tried.",
       0, number_text(100 * kMinEdgeShare) + "%, told only" + unless_not_improved});
  options.add("facet-distance", job.mesher.bounds.facet_distance_mm, Range::above(0),
              {kSizes, "MM", "a distance in mm",
               "Largest distance from the circumcentre of a boundary triangle to the surface, in mm."});
  options.add(
      "max-distance", job.max_distance_mm, Range::above(0),
      {kSizes, "MM", "a distance in mm",
       "Largest distance of any point of the surface from the mesh's boundary, and of any point of that boundary "
       "from the surface, in mm. The mesh is made finer where it is farther."});
}

void declare_run(OptionSet& options, MeshJob& job) {
  options.add(
      "max-vertices", job.mesher.max_vertices, Range::at_least(4),
      {kRun, "N", "a number of vertices",
       "Refinement gives up at this many vertices, with exit status 4 and a word on which rule kept firing; what there "
       "is by then is not improved. A size whose boundary alone takes more is refused."});
  declare_budget_options(options, job.budget, kRun);
  options.add(
      "seeding", job.mesher.seeding, {{"bulk", Seeding::bulk}, {"paper", Seeding::paper}},
      {kRun, "HOW", "a way of seeding",
       "How the first points are chosen. bulk: a sample of the boundary and a lattice inside, inserted at once; "
       "paper: the sample of the boundary alone. Then the rules."});
  options.add("optimize", job.optimize,
              {{"none", Optimize::none}, {"exude", Optimize::exude}, {"full", Optimize::full}},
              {kRun, "HOW", "an optimisation",
               "What is done to flat tetrahedra after refinement. none: nothing; exude: weights on the vertices push "
               "them out, no vertex moves; full: what that leaves is smoothed and reconnected, and meshed finer where "
               "nothing else helps."});
  options.add("order", job.order, {{"1", ElementOrder::first}, {"2", ElementOrder::second}},
              {kRun, "N", "an order of elements",
               "1: tetrahedra of four nodes; 2: of ten, with the nodes on boundary edges on the surface, and every "
               "Jacobian proved positive (docs/second_order.md)."});
  options.add("plan", job.plan,
              {kRun, "", "a flag",
               "Mesh nothing: print how many vertices and tetrahedra, how much memory and how many seconds are to be "
               "expected, and whether that fits. --report FILE.json writes the same; no mesh file is written."});
  options.add("no-theory", job.no_theory,
              {kRun, "", "a flag",
               "Say nothing of bounds beyond what is proven: no note to those who set one, no word in reports."});
  options.add("seed", job.mesher.seed, Range::at_least(0),
              {kRun, "N", "a seed",
               "Seed of the random order in which the boundary sample is drawn. The same seed gives the same mesh."});
  options.add("threads", job.mesher.threads, Range::at_least(0),
              {kRun, "N", "a number of threads",
               "Threads to work with; 0 means one per core. The mesh does not depend on it."});
}

void declare_certify(OptionSet& options, MeshJob& job) {
  const char* const group = "Certificate";
  options.add("certify", job.certify,
              {{"no", Certify::no},
               {"bounded", Certify::bounded},
               {"certified", Certify::certified},
               {"refine", Certify::refine}},
              {group, "GRADE", "a grade, or refine",
               "Verify the mesh as it was written against the scan as it is read again, as scantet verify does, before "
               "files take their names; exit status 4 if the grade is not reached (docs/certificate.md). refine: "
               "certified, and where facets are too coarse for a proof the mesh is made finer. Without a value: "
               "certified. Images and OpenVDB grids, label maps and surfaces with bounded, and no --cut."});
  options.add("certificate", job.certificate,
              {group, "FILE", "a file name",
               "Write the certificate as JSON, with the checksums of scan and mesh; scantet verify --certificate FILE "
               "or scantet-check FILE checks it again."});
}

}  // namespace

void MeshRequest::resolve_bounds() {
  if (optimize == Optimize::none) return;
  min_dihedral_deg = min_dihedral_deg.value_or(kMinDihedralDeg);
  max_dihedral_deg = max_dihedral_deg.value_or(kMaxDihedralDeg);
  min_scaled_jacobian = min_scaled_jacobian.value_or(kMinScaledJacobian);
}

std::optional<EdgeTarget> MeshRequest::edge_target(const SizingField& size) const {
  if (min_edge.empty()) {
    if (optimize == Optimize::none) return std::nullopt;
    return EdgeTarget{0, kMinEdgeShare, &size, false};
  }
  const LengthOrShare length = read_edge_length("--min-edge", min_edge);
  if (length.mm == 0 && length.share == 0) return std::nullopt;
  return EdgeTarget{length.mm, length.share, &size, true};
}

void declare_reports(OptionSet& options, std::vector<std::string>& reports) {
  options.add(
      "report", reports,
      {kOutput, "FILE", "a file name",
       "Report file: .html (a page to explore the mesh in, offline), .svg or .png (the histograms as a picture), "
       ".json (everything, for programs) or .csv (the histograms as a table)."});
}

void declare_wave_speed(OptionSet& options, double& wave_speed_m_per_s) {
  options.add("wave-speed", wave_speed_m_per_s, Range::above(0),
              {kOutput, "M/S", "a speed in m/s",
               "Speed of the fastest wave in the material, for the stable time step of explicit solvers that reports "
               "give: least height of a tetrahedron / speed. 1500 m/s is that of soft tissue and water."});
}

void declare_space(OptionSet& options, Space& space) {
  options.add("space", space, {{"lps", Space::lps}, {"ras", Space::ras}},
              {kOutput, "AXES", "an orientation",
               "World axes of the coordinates written. lps: to the left, the back and the head, as DICOM and ITK; ras: "
               "to the right, the front and the head."});
}

void MeshJob::declare_options(OptionSet& options) {
  declare_sizes(options, *this);
  declare_cut_options(options, cut);
  declare_model_options(options, model);
  options.add("output", outputs,
              {kOutput, "FILE", "a file name",
               "Mesh file; the extension chooses the format (scantet plugins lists them).", 'o'});
  declare_field_options(options, fields);
  options.add("quality-fields", quality_fields,
              {kOutput, "", "a flag",
               "Mesh files carry the measures of each tetrahedron as fields: dihedral angles, ratios, scaled Jacobian, "
               "height, circumradius, volume (docs/fields.md)."});
  declare_reports(options, reports);
  declare_wave_speed(options, wave_speed_m_per_s);
  declare_space(options, space);
  declare_run(options, *this);
  declare_certify(options, *this);
}

void distribute_options(const std::vector<OptionValue>& values, OptionSet& job_options,
                        const std::vector<const OptionSet*>& plugin_options, MeshJob& job) {
  for (const OptionValue& value : values) {
    if (const Option* const option = job_options.find(value.name); option != nullptr) {
      job_options.set(value);
      // A report lists all its options, and that list can be used as a configuration: a default value in it does not
      // count as given.
      const bool typed = value.place.starts_with("--");
      if (typed || option->read() != option->default_values) job.given.push_back(value);
      continue;
    }
    const bool known = std::any_of(plugin_options.begin(), plugin_options.end(),
                                   [&](const OptionSet* set) { return set->find(value.name) != nullptr; });
    if (!known) {
      std::vector<std::string> names;
      for (const Option& option : job_options.options()) names.push_back(option.name);
      for (const OptionSet* set : plugin_options) {
        for (const Option& option : set->options()) names.push_back(option.name);
      }
      const auto meant = closest_name(value.name, names);
      throw Error(Fault::usage, "usage.unknown_option",
                  value.place + ": unknown option" + (meant ? "; did you mean " + *meant + "?" : ""),
                  "scantet mesh --help lists the options");
    }
    job.input_options.push_back(value);
  }
}

}  // namespace scantet
