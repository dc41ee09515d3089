// What a mesh takes falls as the size grows: as its cube where the inside counts, hardly at all where the boundary is
// rough. The size is found by the rule of false position between logarithms.
#include "scantet/size_options/target_size.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "scantet/base/budget.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/quantity.h"

namespace scantet {
namespace {

constexpr int kDigits = 4;       // of a size that is chosen
constexpr int kCountDigits = 2;  // of a prediction
constexpr int kAllDigits = 15;

using Amount = std::function<double(const MeshPrediction&)>;

/// The largest and the least size that make sense for a domain.
struct Ends {
  double least_mm;
  double most_mm;
};

double rounded(double size_mm) {
  return number_in(number_text(size_mm, kDigits)).value_or(size_mm);
}

class Search {
 public:
  Search(const OpenedDomain& opened, double alpha, Amount amount, Progress& progress)
      : opened_(opened), alpha_(alpha), amount_(std::move(amount)), progress_(progress) {}

  /// The size at which the amount is nearly `target`; the largest if it is more there. 0 if cancelled.
  double find(double target, double start_mm, const Ends& ends) {
    constexpr int kSteps = 14;
    constexpr double kNear = 0.005;
    double size_mm = std::clamp(start_mm, ends.least_mm, ends.most_mm);
    double low_mm = ends.least_mm;  // too much there
    double high_mm = ends.most_mm;  // too little, or the end
    double slope = -2.5;
    double last = 0;
    double last_mm = 0;
    for (int step = 0; step < kSteps; ++step) {
      const double now = amount_at(size_mm);
      if (progress_.cancelled()) return 0;
      const double off = std::log(now / target);
      if (std::abs(off) < kNear || (off > 0 && size_mm == ends.most_mm) || (off < 0 && size_mm == ends.least_mm)) break;
      (off > 0 ? low_mm : high_mm) = size_mm;
      if (last_mm > 0 && last_mm != size_mm) {
        slope = std::clamp(std::log(now / last) / std::log(size_mm / last_mm), -3.2, -0.2);
      }
      last = now;
      last_mm = size_mm;
      double next_mm = size_mm * std::exp(-off / slope);
      if (!(next_mm > low_mm && next_mm < high_mm)) {
        const bool is_open = (off > 0 && high_mm == ends.most_mm) || (off < 0 && low_mm == ends.least_mm);
        next_mm = is_open ? std::clamp(next_mm, ends.least_mm, ends.most_mm) : std::sqrt(low_mm * high_mm);
      }
      size_mm = next_mm;
    }
    return rounded(size_mm);
  }

  double amount_at(double size_mm) {
    const UniformSize size(size_mm);
    const auto features = find_features(*opened_.domain, size, alpha_, finest_mm(opened_), progress_);
    return features ? amount_(predict(*features)) : 0;
  }

 private:
  const OpenedDomain& opened_;
  double alpha_;
  Amount amount_;
  Progress& progress_;
};

Ends ends_of(const OpenedDomain& opened) {
  constexpr double kFinest = 1e-4;  // of the diagonal
  constexpr double kCoarsest = 0.25;
  const double diagonal_mm = opened.domain->bounds().diagonal();
  return {std::max(opened.min_size_mm.value_or(0), kFinest * diagonal_mm), kCoarsest * diagonal_mm};
}

// In full, where that says something: 470000.
std::string count_text(double count, int digits) {
  constexpr double kPlain = 1e12;
  const double rounded = number_in(number_text(count, digits)).value_or(count);
  return rounded < kPlain ? std::to_string(static_cast<std::uint64_t>(rounded)) : number_text(count, digits);
}

void refuse_other_sizes(const SizeOptions& sizes) {
  const char* other = !sizes.size.empty()            ? "--size"
                      : !sizes.boundary_size.empty() ? "--boundary-size"
                      : !sizes.region_sizes.empty()  ? "--region-size"
                      : !sizes.size_where.empty()    ? "--size-where"
                                                     : nullptr;
  if (other != nullptr) {
    throw Error(Fault::usage, "usage.target_tets",
                std::string("--target-tets: it chooses the size, and ") + other + " asks for one",
                "give one of the two");
  }
  if (sizes.layers.empty()) return;
  throw Error(Fault::usage, "usage.target_tets",
              "--target-tets: it chooses one size everywhere, and --layers asks for smaller ones in thin parts",
              "give one of the two; --plan tells how many tets are to be expected with --size and --layers");
}

TargetSize size_for_tets(double tets, const SizeLimits& limits, const OpenedDomain& opened, Progress& progress) {
  constexpr double kFarOff = 1.1;
  Search search(
      opened, limits.alpha, [](const MeshPrediction& mesh) { return mesh.tets; }, progress);
  const double size_mm = search.find(tets, opened.default_size_mm, ends_of(opened));
  if (progress.cancelled()) return {};
  const double expected = search.amount_at(size_mm);
  if (expected > kFarOff * tets) {
    throw Error(Fault::usage, "usage.target_tets",
                "--target-tets " + count_text(tets, kAllDigits) + ": however large the size, about " +
                    count_text(expected, kCountDigits) + " tets are to be expected of this object",
                "ask for more, or make a rough scan simpler: --smooth, --min-component, --fill-cavities");
  }
  return {size_mm, "--target-tets " + count_text(tets, kAllDigits) + ": size " + number_text(size_mm) +
                       " mm, of which about " + count_text(expected, kCountDigits) + " tets are to be expected"};
}

// What the program holds before it meshes, but by the input alone, so that the same size is chosen in every run: the
// program itself and four bytes for each voxel.
double held_bytes(const OpenedDomain& opened) {
  constexpr double kProgram = 5e7;
  constexpr double kVoxel = 4;
  if (!opened.frame) return kProgram;
  const Vec extent = opened.domain->bounds().extent();
  return kProgram + kVoxel * extent.x * extent.y * extent.z / std::abs(opened.frame->determinant_mm3());
}

std::optional<TargetSize> size_for_memory(const SizeLimits& limits, const OpenedDomain& opened, Progress& progress) {
  constexpr double kRoom = 0.85;  // of what is left: a prediction is not exact
  const double left = kRoom * (*limits.memory_bytes - held_bytes(opened));
  Search search(
      opened, limits.alpha, [](const MeshPrediction& mesh) { return mesh.bytes; }, progress);
  const double own = search.amount_at(opened.default_size_mm);
  if (progress.cancelled() || own <= left) return std::nullopt;
  const double size_mm = left > 0 ? search.find(left, opened.default_size_mm, ends_of(opened)) : 0;
  if (progress.cancelled()) return std::nullopt;
  if (size_mm == 0 || search.amount_at(size_mm) > left / kRoom) {
    if (!limits.refuse) return std::nullopt;
    throw Error(Fault::usage, "usage.memory",
                "--max-memory " + limits.memory_text + ": however large the size, the mesh of this object takes more",
                "allow more, or make a rough scan simpler: --smooth, --resample");
  }
  return TargetSize{size_mm, "no --size given: size " + number_text(size_mm) + " mm, as a mesh of " +
                                 number_text(opened.default_size_mm) + " mm is expected to take " +
                                 bytes_text(own + held_bytes(opened)) + ", more than --max-memory " +
                                 limits.memory_text};
}

}  // namespace

std::optional<double> finest_mm(const OpenedDomain& opened) {
  return opened.frame ? std::optional(opened.frame->min_spacing_mm()) : std::nullopt;
}

SizeRequest number_request(double size_mm) {
  return read_size("--size", number_text(size_mm));
}

std::optional<TargetSize> choose_target_size(const SizeOptions& sizes, const SizePlan& plan, const SizeLimits& limits,
                                             const OpenedDomain& opened, Progress& progress) {
  if (sizes.target_tets) {
    refuse_other_sizes(sizes);
    return size_for_tets(*sizes.target_tets, limits, opened, progress);
  }
  const bool has_size = plan.inside.kind != SizeRequest::Kind::unset ||
                        plan.boundary.kind != SizeRequest::Kind::unset || plan.has_region_sizes() ||
                        !plan.places.empty() || plan.layers.layers > 0;
  if (has_size || !limits.memory_bytes) return std::nullopt;
  return size_for_memory(limits, opened, progress);
}

}  // namespace scantet
