// Two kinds of fields: sizes inside, uniform or on a grid, and sizes on the boundary that grow inward. Where both are
// asked for, the least counts, so a size on the boundary that is larger than inside makes no difference: tets there
// obey the size inside, and their facets are no larger than they.
#include "scantet/size_options/size_choice.h"

#include <cmath>
#include <limits>
#include <set>

#include "scantet/base/error.h"
#include "scantet/io/input_files.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/sizing/boundary_size.h"
#include "scantet/sizing/size_grid.h"
#include "scantet/sizing/size_image.h"

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFirstLook = 1.0 / 128;  // of the longest side of the bounds: between points of the boundary

/// Makes the fields of one job.
class Chooser {
 public:
  Chooser(const SizeOptions& options, const SizePlan& plan, const OpenedDomain& opened, Progress& progress)
      : options_(options), plan_(plan), opened_(opened), domain_(*opened.domain), progress_(progress) {}

  ChosenSize run() {
    using Kind = SizeRequest::Kind;
    if (!plan_.regions.empty()) check_regions();
    refuse_idle_boundary_size();
    choose_text();
    const bool bounds_inside = plan_.inside.kind != Kind::automatic || !plan_.regions.empty();
    if (bounds_inside) fields_.push_back(inside_field());
    if (plan_.boundary.kind != Kind::unset) {
      fields_.push_back(boundary_field(plan_.boundary, bounds_inside));
    } else if (plan_.goes_by_shape()) {
      fields_.push_back(boundary_field(plan_.inside, bounds_inside));
    }
    if (progress_.cancelled()) return {};
    const auto* uniform = dynamic_cast<const UniformSize*>(fields_.front().get());
    if (fields_.size() == 1 && uniform != nullptr) {
      result_.uniform_mm = uniform->min_size();
      result_.field = fields_.front();
      return std::move(result_);
    }
    result_.field = fields_.size() == 1 ? fields_.front() : std::make_shared<LeastSize>(fields_);
    result_.expected_vertices = std::max(result_.expected_vertices, expected_inside());
    return std::move(result_);
  }

 private:
  double first_look_mm() const {
    const Vec extent = domain_.bounds().extent();
    return kFirstLook * std::max({extent.x, extent.y, extent.z});
  }

  /// The domain's own list; if it has none, what is found along its boundary.
  std::set<Region> regions() const {
    std::set<Region> found;
    for (const Component& component : domain_.components()) found.insert(component.region);
    if (found.empty()) {
      domain_.surface_candidates(first_look_mm(), [&](const Point& p) {
        any_region_around(p, first_look_mm(), [&](Region region) {
          found.insert(region);
          return false;
        });
      });
    }
    found.erase(kOutside);
    return found;
  }

  void check_regions() const {
    const std::set<Region> known = regions();
    for (const auto& [region, size] : plan_.regions) {
      if (known.empty() || known.contains(region)) continue;
      throw Error(Fault::usage, "usage.region_size",
                  "--region-size: the object has no region " + std::to_string(region),
                  *known.rbegin() == 1 ? "its only region is 1"
                                       : "its regions are numbered from 1 to " + std::to_string(*known.rbegin()));
    }
  }

  void choose_text() {
    result_.text = plan_.inside.text;
    if (plan_.inside.kind != SizeRequest::Kind::unset) return;
    result_.text = number_text(opened_.default_size_mm);
    result_.notes.push_back("no --size given: size " + result_.text + " mm, " + opened_.default_size_reason);
  }

  double uniform_mm() const {
    return plan_.inside.kind == SizeRequest::Kind::number ? plan_.inside.size_mm : opened_.default_size_mm;
  }

  /// A number on the boundary counts where it is less than inside.
  void refuse_idle_boundary_size() const {
    using Kind = SizeRequest::Kind;
    const bool one_number = plan_.inside.kind == Kind::number || plan_.inside.kind == Kind::unset;
    if (!one_number || plan_.boundary.kind != Kind::number) return;
    double largest_mm = uniform_mm();
    for (const auto& [region, size_mm] : plan_.regions) largest_mm = std::max(largest_mm, size_mm);
    if (plan_.boundary.size_mm < largest_mm) return;
    throw Error(Fault::usage, "usage.no_effect",
                "--boundary-size: it does nothing here: " + plan_.boundary.text +
                    " mm is not less than the size inside, " + number_text(largest_mm) + " mm",
                "leave it out, or choose less than that");
  }

  std::shared_ptr<const SizingField> inside_field() {
    using Kind = SizeRequest::Kind;
    const bool one_number = plan_.inside.kind == Kind::number || plan_.inside.kind == Kind::unset;
    if (one_number && plan_.regions.empty()) return std::make_shared<UniformSize>(uniform_mm());
    std::shared_ptr<const SizeSource> source = std::make_shared<UniformSource>(one_number ? uniform_mm() : kInfinity);
    if (plan_.inside.kind == Kind::source) source = source_of(plan_.inside);
    if (source && !plan_.regions.empty()) source = std::make_shared<RegionSource>(source, plan_.regions);
    if (!source) return nullptr;
    SizeGridOptions grid_options;
    grid_options.least_mm = plan_.inside.kind == Kind::source ? options_.least_mm.value_or(0) : 0;
    grid_options.longest_mm = domain_.bounds().diagonal();
    grid_options.place = plan_.inside.option;
    grid_options.text = plan_.inside.text;
    const auto grid = make_size_grid(domain_, *source, grid_options, progress_);
    if (!grid) return nullptr;
    result_.notes.push_back("sizes from " + number_text(grid->min_size(), 3) +
                            " mm on, made 1-Lipschitz, on a grid of " + number_text(grid->step_mm(), 3) +
                            " mm: at most " + number_text(grid->error_mm(), 3) + " mm off");
    return grid;
  }

  /// Null if cancelled.
  std::shared_ptr<const SizeSource> source_of(const SizeRequest& request) {
    if (request.kind == SizeRequest::Kind::number) return std::make_shared<UniformSource>(request.size_mm);
    if (request.image.empty()) return request.source;
    constexpr bool kMayBeConstant = true;
    const Scan scan = read_scan(request.image, progress_, kMayBeConstant);
    if (progress_.cancelled()) return nullptr;
    for (const std::string& file : input_files(request.image)) result_.files.push_back(file);
    const Box covered =
        scan.frame.world_box({-0.5, -0.5, -0.5}, {scan.size[0] - 0.5, scan.size[1] - 0.5, scan.size[2] - 0.5});
    const Box object = domain_.bounds();
    for (int axis = 0; axis < 3; ++axis) {
      if (covered.min[axis] <= object.max[axis] && covered.max[axis] >= object.min[axis]) continue;
      throw Error(Fault::input, "input.size_image",
                  request.image + ": the image of sizes is elsewhere than the object: along axis " +
                      std::string(1, "xyz"[axis]) + " it covers " + number_text(covered.min[axis], 5) + " to " +
                      number_text(covered.max[axis], 5) + " mm, the object " + number_text(object.min[axis], 5) +
                      " to " + number_text(object.max[axis], 5) + " mm",
                  "check its origin and directions");
    }
    return std::make_shared<SizeImage>(scan);
  }

  std::shared_ptr<const SizingField> boundary_field(const SizeRequest& request, bool bounds_inside) {
    double spacing_mm = 0;
    std::vector<Cone> sizes =
        request.kind == SizeRequest::Kind::automatic ? feature_cones(spacing_mm) : asked_cones(request, spacing_mm);
    if (sizes.empty()) return nullptr;  // cancelled
    double vertices = 0;
    const double apart = std::min(spacing_mm, domain_.bounds().diagonal());
    for (const Cone& cone : sizes) vertices += apart * apart / (cone.height_mm * cone.height_mm);
    result_.expected_vertices = std::max(result_.expected_vertices, vertices);
    return std::make_shared<BoundarySize>(std::move(sizes), spacing_mm, bounds_inside);
  }

  /// The sizes that auto gives on the boundary.
  std::vector<Cone> feature_cones(double& spacing_mm) {
    constexpr double kLeastShare = 1.0 / 200;  // of the longest side of an object that is no image
    constexpr double kPerFeature = 4;          // sample points along the least feature that counts
    const Vec extent = domain_.bounds().extent();
    const double usual_least =
        opened_.frame ? opened_.frame->min_spacing_mm() : kLeastShare * std::max({extent.x, extent.y, extent.z});
    const double least_mm = options_.least_mm.value_or(std::max(usual_least, opened_.min_size_mm.value_or(0)));
    const double share = options_.feature_share.value_or(kFeatureShare);
    FeatureOptions how;
    how.lipschitz_k = options_.lipschitz_k;
    how.spacing_mm = std::max(0.5 * least_mm, least_mm / share / kPerFeature);
    FeatureSizes features = feature_sizes(domain_, how, progress_);
    if (features.sizes.empty()) return {};
    spacing_mm = features.spacing_mm;
    double smallest = kInfinity;
    double largest = 0;
    for (Cone& cone : features.sizes) {
      cone.height_mm = std::max(least_mm, share * cone.height_mm);
      smallest = std::min(smallest, cone.height_mm);
      largest = std::max(largest, cone.height_mm);
    }
    result_.notes.push_back("auto: sizes from " + number_text(smallest, 3) + " to " + number_text(largest, 3) +
                            " mm on the boundary, " + number_text(share) + " x its " +
                            (how.lipschitz_k ? "Lipschitz radius" : "distance to the medial axis") + ", at least " +
                            number_text(least_mm, 3) + " mm, from a sample " + number_text(spacing_mm, 3) +
                            " mm apart: narrower places may be passed over");
    return std::move(features.sizes);
  }

  /// The sizes that were asked for on the boundary.
  std::vector<Cone> asked_cones(const SizeRequest& request, double& spacing_mm) {
    constexpr double kSpacing = 0.5;  // of the size
    const std::shared_ptr<const SizeSource> source = source_of(request);
    if (!source) return {};
    const bool is_number = request.kind == SizeRequest::Kind::number;
    spacing_mm = is_number ? kSpacing * request.size_mm : first_look_mm();
    std::vector<SizePlace> places;
    for (const Point& p : boundary_sample(domain_, spacing_mm, progress_))
      places.push_back({p, 0, region_by(p, spacing_mm)});
    std::vector<double> asked(places.size());
    source->sizes_at(places, asked);
    std::vector<Cone> sizes;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!(asked[i] > 0)) refuse_size(request.option, request.text, places[i], false, asked[i]);
      const double least = is_number ? 0 : options_.least_mm.value_or(0);
      sizes.push_back({places[i].point, std::min(std::max(asked[i], least), domain_.bounds().diagonal())});
    }
    return sizes;
  }

  /// Whether is_it(region) holds for a region around a point of the boundary.
  template <class IsIt>
  bool any_region_around(const Point& p, double spacing_mm, const IsIt& is_it) const {
    constexpr double kProbe = 0.05;
    for (int n = 0; n < 27; ++n) {
      const Vec off{n % 3 - 1.0, n / 3 % 3 - 1.0, n / 9 - 1.0};
      if (is_it(domain_.region_at(p + (kProbe * spacing_mm) * off))) return true;
    }
    return false;
  }

  /// The region that a point of the boundary belongs to: the first found around it.
  Region region_by(const Point& p, double spacing_mm) const {
    Region found = kOutside;
    any_region_around(p, spacing_mm, [&](Region region) { return (found = region) != kOutside; });
    return found;
  }

  /// Vertices inside, roughly: one for each cube of the size.
  double expected_inside() const {
    constexpr int kCells = 40;  // along each axis
    const Box bounds = domain_.bounds();
    const Vec cell = (1.0 / kCells) * bounds.extent();
    double vertices = 0;
    for (int n = 0; n < kCells * kCells * kCells; ++n) {
      const Vec place{n % kCells + 0.5, n / kCells % kCells + 0.5, n / kCells / kCells + 0.5};
      const Point p = bounds.min + Vec{place.x * cell.x, place.y * cell.y, place.z * cell.z};
      if (domain_.region_at(p) == kOutside) continue;
      const double size = result_.field->size_at(p);
      vertices += cell.x * cell.y * cell.z / (size * size * size);
    }
    return vertices;
  }

  const SizeOptions& options_;
  const SizePlan& plan_;
  const OpenedDomain& opened_;
  const Domain& domain_;
  Progress& progress_;
  ChosenSize result_;
  std::vector<std::shared_ptr<const SizingField>> fields_;
};

}  // namespace

ChosenSize choose_size(const SizeOptions& options, const SizePlan& plan, const OpenedDomain& opened,
                       Progress& progress) {
  return Chooser(options, plan, opened, progress).run();
}

}  // namespace scantet
