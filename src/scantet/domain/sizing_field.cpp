// Fields made of others. Places are cones, looked up in a tree.
#include "scantet/domain/sizing_field.h"

#include <algorithm>

namespace scantet {
namespace {

std::vector<Cone> cones_of(const std::vector<FinerPlace>& places) {
  std::vector<Cone> cones;
  cones.reserve(places.size());
  for (const FinerPlace& place : places) cones.push_back({place.point, place.size_mm});
  return cones;
}

template <class Value>
double least_of(const std::vector<std::shared_ptr<const SizingField>>& fields, Value value) {
  double least = value(*fields.front());
  for (const auto& field : fields) least = std::min(least, value(*field));
  return least;
}

}  // namespace

FinerSize::FinerSize(std::shared_ptr<const SizingField> elsewhere, const std::vector<FinerPlace>& places)
    : elsewhere_(std::move(elsewhere)),
      least_mm_(elsewhere_->min_size()),
      usual_mm_(elsewhere_->usual_size()),
      places_(cones_of(places)) {
  for (const FinerPlace& place : places) least_mm_ = std::min(least_mm_, place.size_mm);
  // Elsewhere all is alike: that the whole boundary is looked at closely costs little beside the mesh.
  if (usual_mm_ == elsewhere_->min_size()) usual_mm_ = least_mm_;
}

double FinerSize::size_down_to(const Point& p, double least_mm) const {
  const double size_mm = elsewhere_->size_down_to(p, least_mm);
  return size_mm > least_mm ? std::max(places_.lowest_at(p, size_mm).value_mm, least_mm) : least_mm;
}

double LeastSize::size_down_to(const Point& p, double least_mm) const {
  double size_mm = std::numeric_limits<double>::infinity();
  for (const auto& field : fields_) {
    size_mm = std::min(size_mm, field->size_down_to(p, least_mm));
    if (!(size_mm > least_mm)) return least_mm;
  }
  return size_mm;
}

double LeastSize::size_up_to(const Point& p, double most_mm) const {
  for (const auto& field : fields_) most_mm = field->size_up_to(p, most_mm);
  return most_mm;
}

double LeastSize::min_size() const {
  return least_of(fields_, [](const SizingField& field) { return field.min_size(); });
}

double LeastSize::usual_size() const {
  return least_of(fields_, [](const SizingField& field) { return field.usual_size(); });
}

bool LeastSize::bounds_tets() const {
  return std::any_of(fields_.begin(), fields_.end(), [](const auto& field) { return field->bounds_tets(); });
}

}  // namespace scantet
