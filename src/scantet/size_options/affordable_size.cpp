// The limit on vertices ends a refinement that is too fine. A size far below that would drown the sampling before it,
// so it is refused here.
#include "scantet/size_options/affordable_size.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/memory.h"
#include "scantet/base/quantity.h"
#include "scantet/size_options/boundary_cones.h"
#include "scantet/size_options/mesh_prediction.h"
#include "scantet/size_options/prediction_coefficients.h"
#include "scantet/size_options/target_size.h"
#include "scantet/sizing/interface_gap.h"

namespace scantet {
namespace {

// Two digits are all that an estimate is worth: 4200, 1.2e+31.
std::string about(double count) {
  constexpr double kPlain = 1e12;
  constexpr double kMost = 1e300;
  const double unit = std::pow(10, std::floor(std::log10(std::clamp(count, 1.0, kMost))) - 1);
  const double rounded = std::round(std::min(count, kMost) / unit) * unit;
  return rounded < kPlain ? std::to_string(static_cast<std::uint64_t>(rounded)) : number_text(rounded, 2);
}

// Three digits that are not below the value: what is advised is accepted.
std::string rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return number_text(std::ceil(value / unit) * unit, 3);
}

void refuse_too_fine(const SizeLimits& limits, const OpenedDomain& opened, double size_mm) {
  if (!opened.min_size_mm || size_mm >= *opened.min_size_mm) return;
  throw Error(Fault::usage, "usage.size",
              "--size: " + number_text(size_mm, 6) + " mm is finer than " + limits.input +
                  " can tell: " + opened.min_size_reason,
              "choose --size " + rounded_up(*opened.min_size_mm) + " or more");
}

// A limit far below what the boundary takes is told of before the boundary is looked at closely, which takes seconds.
void refuse_far_too_few(const SizeOptions& sizes, const SizePlan& plan, const SizeLimits& limits,
                        const OpenedDomain& opened, Progress& progress) {
  constexpr double kSure = 2;
  if (!plan.goes_by_shape() || limits.max_vertices >= limits.usual_max_vertices) return;
  const double per_size = std::max(1.0, limits.alpha * limits.alpha);
  const double vertices = rough_vertices(*opened.domain, auto_sizes(sizes, opened), progress) / per_size;
  if (vertices <= kSure * static_cast<double>(limits.max_vertices)) return;
  throw Error(Fault::usage, "usage.max_vertices",
              "--max-vertices: the boundary alone takes about " + about(vertices) +
                  " vertices or more at this size, and no more than " + std::to_string(limits.max_vertices) +
                  " are allowed",
              "allow more, or choose a larger --size");
}

// Vertices that nothing is begun with: far beyond the limit, or its default.
double hopeless_vertices(const SizeLimits& limits) {
  constexpr double kHopeless = 10;
  return kHopeless * static_cast<double>(std::max(limits.max_vertices, limits.usual_max_vertices));
}

// What is to be expected of the mesh. To look at the boundary takes as long as a small mesh, so that is done only where
// the inside by itself comes within a factor of a limit, or where nothing is known of it, as of an object too thin.
MeshPrediction expected_mesh(const SizeLimits& limits, const ChosenSize& chosen, const OpenedDomain& opened,
                             Progress& progress) {
  constexpr double kRough = 20;
  const MeshPrediction inside = predict(find_inside(*opened.domain, *chosen.field));
  const double memory = limits.memory_bytes.value_or(available_bytes());
  const double vertices = std::max(inside.vertices, chosen.expected_vertices);
  const bool is_far = inside.vertices > 0 && kRough * vertices <= static_cast<double>(limits.max_vertices) &&
                      kRough * inside.bytes <= memory;
  MeshPrediction expected = inside;
  if (!is_far && vertices <= hopeless_vertices(limits)) {
    const auto features = find_features(*opened.domain, *chosen.field, limits.alpha, finest_mm(opened), progress);
    if (features) expected = predict(*features);
  }
  if (expected.vertices < chosen.expected_vertices) {
    expected.bytes += kByteCosts.boundary * (chosen.expected_vertices - expected.vertices);
    expected.vertices = chosen.expected_vertices;
  }
  return expected;
}

// A size whose mesh will not fit into the memory is refused before hours of work go into it.
void refuse_too_much_memory(const SizeLimits& limits, const std::string& asked, const MeshPrediction& expected,
                            double least_mm) {
  const std::optional<double> allowed = limits.memory_bytes;
  const double memory = allowed ? *allowed - resident_bytes() : available_bytes();
  const double limit = static_cast<double>(limits.max_vertices);
  const double share = expected.vertices > limit ? limit / expected.vertices : 1;  // of the mesh, by when it ends
  const double bytes = share * expected.bytes;
  if (bytes <= memory) return;
  const double enough_mm = least_mm * std::cbrt(expected.bytes / std::max(memory, 1.0));
  throw Error(Fault::usage, "usage.memory",
              asked + " about " + about(share * expected.vertices) + " vertices, which take about " +
                  bytes_text(bytes) + " of memory; " +
                  (allowed ? "--max-memory is " + limits.memory_text : bytes_text(memory) + " is available"),
              "choose a larger size, about " + number_text(enough_mm, 2) + " mm or more, a lower --max-vertices" +
                  (allowed ? "" : ", or a --max-memory that it may take all the same"));
}

// Several levels that come close to each other take a mesh as fine as the gap, however large the size is. size_mm: the
// least.
std::string note_on_gaps(const SizeLimits& limits, const InterfaceGaps& gaps, double size_mm) {
  const double limit = static_cast<double>(limits.max_vertices);
  std::string what = "the surfaces between regions are closer to each other than the size on " +
                     number_text(std::ceil(100 * gaps.share), 3) + " % of their area, " +
                     number_text(gaps.median_mm, 2) + " mm at the median, down to " + number_text(gaps.least_mm, 2) +
                     " mm; to keep them apart takes about " + about(gaps.expected_vertices) + " vertices";
  if (gaps.expected_vertices > limit) what += ", and --max-vertices is " + std::to_string(limits.max_vertices);
  std::string remedy = "levels further apart take fewer";
  if (gaps.expected_vertices > hopeless_vertices(limits)) throw Error(Fault::usage, "usage.gap", what, remedy);
  // Untangling gives up what is small beside the size: at three gaps that is little (docs/algorithm.md).
  const double wise_mm = 3 * gaps.median_mm;
  if (size_mm > wise_mm) remedy += ", and a --size of " + number_text(wise_mm, 2) + " keeps more of what is in between";
  return what + "; " + remedy;
}

// The options that sizes were given with, as they were given.
std::string asked_sizes(const SizeOptions& sizes, const std::string& inside) {
  std::string text = "--size " + inside;
  if (!sizes.boundary_size.empty()) text += ", --boundary-size " + sizes.boundary_size;
  for (const std::string& size : sizes.region_sizes) text += ", --region-size " + size;
  for (const std::string& size : sizes.size_where) text += ", --size-where " + size;
  return text;
}

}  // namespace

ChosenSize choose_affordable_size(const SizeOptions& sizes, const SizePlan& plan, const SizeLimits& limits,
                                  const OpenedDomain& opened, Progress& progress) {
  SizePlan resolved = plan;
  if (limits.refuse) refuse_far_too_few(sizes, plan, limits, opened, progress);
  const std::optional<TargetSize> target = choose_target_size(sizes, plan, limits, opened, progress);
  if (progress.cancelled()) return {};
  if (target) resolved.inside = number_request(target->size_mm);
  ChosenSize chosen = choose_size(sizes, resolved, opened, progress);
  if (!chosen.field) return chosen;
  if (target) chosen.notes.push_back(target->note);
  refuse_too_fine(limits, opened, chosen.field->min_size());
  if (!limits.refuse) return chosen;
  const MeshPrediction mesh = expected_mesh(limits, chosen, opened, progress);
  const double expected = mesh.vertices;
  const double limit = static_cast<double>(limits.max_vertices);
  const InterfaceGaps gaps = interface_gaps(*opened.domain, *chosen.field, limits.alpha, progress);
  if (gaps.expected_vertices > expected) {
    chosen.notes.push_back(note_on_gaps(limits, gaps, chosen.field->min_size()));
  }
  const double least_mm = chosen.field->min_size();
  const std::string asked =
      chosen.uniform_mm ? "--size: " + number_text(least_mm) + " mm means"
                        : asked_sizes(sizes, chosen.text) + ": sizes from " + number_text(least_mm, 3) + " mm on mean";
  if (expected <= limit) {
    refuse_too_much_memory(limits, asked, mesh, least_mm);
    return chosen;
  }
  const std::string what =
      asked + " about " + about(expected) + " vertices, and --max-vertices is " + std::to_string(limits.max_vertices);
  const double enough_mm = least_mm * std::cbrt(expected / limit);
  const std::string remedy =
      "choose a larger size" + (std::isfinite(enough_mm) ? ", about " + number_text(enough_mm, 2) + " mm or more" : "");
  if (expected > hopeless_vertices(limits)) throw Error(Fault::usage, "usage.size", what, remedy);
  refuse_too_much_memory(limits, asked, mesh, least_mm);
  chosen.notes.push_back(what + "; " + remedy);
  return chosen;
}

}  // namespace scantet
