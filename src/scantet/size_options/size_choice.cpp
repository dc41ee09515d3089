// Two kinds of fields: sizes inside, uniform or on a grid, and sizes on the boundary that grow inward. Where both are
// asked for, the least counts, so a size on the boundary that is larger than inside makes no difference: tets there
// obey the size inside, and their facets are no larger than they.
#include "scantet/size_options/size_choice.h"

#include <algorithm>
#include <limits>

#include "scantet/size_options/boundary_cones.h"
#include "scantet/size_options/layer_sizes.h"
#include "scantet/size_options/region_names.h"
#include "scantet/size_options/size_notes.h"
#include "scantet/size_options/size_plan_check.h"
#include "scantet/size_options/size_sources.h"
#include "scantet/sizing/boundary_size.h"
#include "scantet/sizing/size_grid.h"

namespace scantet {
namespace {

using Kind = SizeRequest::Kind;
using Field = std::shared_ptr<const SizingField>;

/// Makes the fields of one job; those it makes are null if cancelled.
class Chooser {
 public:
  Chooser(const SizeOptions& options, const SizePlan& plan, const OpenedDomain& opened, Progress& progress)
      : options_(options), plan_(plan), opened_(opened), domain_(*opened.domain), progress_(progress) {}

  ChosenSize run() {
    choose_text();
    const bool bounds_inside = plan_.inside.kind != Kind::automatic || !plan_.regions.empty() || !plan_.places.empty();
    std::vector<Field> fields;
    if (bounds_inside) fields.push_back(inside_field());
    if (plan_.boundary.kind != Kind::unset) {
      fields.push_back(boundary_field(plan_.boundary, bounds_inside));
    } else if (plan_.goes_by_shape()) {
      fields.push_back(boundary_field(plan_.inside, bounds_inside));
    }
    if (progress_.cancelled()) return {};
    if (plan_.layers.layers > 0) add_layers(fields);
    if (progress_.cancelled()) return {};
    const auto* uniform = dynamic_cast<const UniformSize*>(fields.front().get());
    if (fields.size() == 1 && uniform != nullptr) {
      result_.uniform_mm = uniform->min_size();
      result_.field = fields.front();
      return std::move(result_);
    }
    result_.field = fields.size() == 1 ? fields.front() : std::make_shared<LeastSize>(fields);
    return std::move(result_);
  }

 private:
  void choose_text() {
    result_.text = plan_.inside.text;
    if (plan_.inside.kind != Kind::unset) return;
    result_.text = number_text(opened_.default_size_mm);
    result_.notes.push_back(note_on_default(result_.text, opened_.default_size_reason));
  }

  std::shared_ptr<const SizeSource> source_of(const SizeRequest& request) {
    return read_source(request, domain_.bounds(), progress_, result_.files);
  }

  Field inside_field() {
    const bool one_size = plan_.has_one_size_inside();
    const double one_size_mm = plan_.one_size_mm(opened_.default_size_mm);
    if (one_size && plan_.regions.empty() && plan_.places.empty()) return std::make_shared<UniformSize>(one_size_mm);
    constexpr double kNoBound = std::numeric_limits<double>::infinity();
    std::shared_ptr<const SizeSource> source = std::make_shared<UniformSource>(one_size ? one_size_mm : kNoBound);
    if (plan_.inside.kind == Kind::source) source = source_of(plan_.inside);
    if (source && !plan_.regions.empty()) source = std::make_shared<RegionSource>(source, plan_.regions);
    if (source && !plan_.places.empty()) source = place_source(source, plan_.places, progress_, result_.files);
    if (!source) return nullptr;
    SizeGridOptions grid_options;
    grid_options.least_mm = plan_.inside.kind == Kind::source ? options_.least_mm.value_or(0) : 0;
    grid_options.longest_mm = domain_.bounds().diagonal();
    grid_options.place = plan_.inside.option;
    grid_options.text = plan_.inside.text;
    const auto grid = make_size_grid(domain_, *source, grid_options, progress_);
    if (grid) result_.notes.push_back(note_on_grid(*grid));
    return grid;
  }

  /// Adds the sizes that thin parts take beside those there are.
  void add_layers(std::vector<Field>& fields) {
    constexpr double kThinnest = 0.5;  // of a voxel
    constexpr double kVoxels = 2;      // of the default size of an image
    const double voxel_mm = opened_.frame ? opened_.frame->min_spacing_mm() : opened_.default_size_mm / kVoxels;
    result_.layers =
        LayerSettings{plan_.layers.layers, regions_in_layers(plan_.layers, domain_), voxel_mm, kThinnest * voxel_mm};
    std::vector<Cone> sizes = layer_sizes(domain_, *result_.layers, LeastSize(fields), progress_);
    result_.notes.push_back(note_on_layers(*result_.layers, sizes));
    if (sizes.empty()) return;
    const bool bounds_tets = true;
    fields.push_back(std::make_shared<BoundarySize>(std::move(sizes), voxel_mm, bounds_tets));
  }

  Field boundary_field(const SizeRequest& request, bool bounds_inside) {
    BoundaryCones cones = cones_of(request);
    if (cones.sizes.empty()) return nullptr;
    result_.expected_vertices = std::max(result_.expected_vertices, vertices_of(cones, domain_));
    return std::make_shared<BoundarySize>(std::move(cones.sizes), cones.spacing_mm, bounds_inside);
  }

  BoundaryCones cones_of(const SizeRequest& request) {
    if (request.kind != Kind::automatic) {
      const std::shared_ptr<const SizeSource> source = source_of(request);
      if (!source) return {};
      return asked_cones(domain_, request, *source, options_.least_mm.value_or(0), progress_);
    }
    const AutoSizes how = auto_sizes(options_, opened_);
    BoundaryCones cones = auto_cones(domain_, how, progress_);
    if (!cones.sizes.empty()) result_.notes.push_back(note_on_auto(cones, how));
    return cones;
  }

  const SizeOptions& options_;
  const SizePlan& plan_;
  const OpenedDomain& opened_;
  const Domain& domain_;
  Progress& progress_;
  ChosenSize result_;
};

}  // namespace

ChosenSize choose_size(const SizeOptions& options, const SizePlan& plan, const OpenedDomain& opened,
                       Progress& progress) {
  const SizePlan numbered = plan_with_numbers(plan, *opened.domain);
  check_plan(numbered, opened);
  return Chooser(options, numbered, opened, progress).run();
}

}  // namespace scantet
