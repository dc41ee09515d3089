// An image may be constant here: one size everywhere is a size.
#include "scantet/size_options/size_sources.h"

#include <algorithm>
#include <limits>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/io/input_files.h"
#include "scantet/places/place_shapes.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/sizing/size_image.h"

namespace scantet {
namespace {

/// Over how short a way it may change whether a point is in the place, mm: the smallest extent of its shapes, or the
/// smallest spacing of its scans.
double finest_of(const Place& place, const ScanTable& scans) {
  const std::vector<double>& n = place.numbers;
  switch (place.kind) {
    case Place::Kind::box:
      return std::min({n[3] - n[0], n[4] - n[1], n[5] - n[2]});
    case Place::Kind::ball:
      return n[3];
    case Place::Kind::cylinder:
      return std::min(n[6], distance({n[0], n[1], n[2]}, {n[3], n[4], n[5]}));
    case Place::Kind::above:
    case Place::Kind::below:
      return scans.at(place.name).scan().frame.min_spacing_mm();
    default: {
      double finest = std::numeric_limits<double>::infinity();
      for (const Place& part : place.parts) finest = std::min(finest, finest_of(part, scans));
      return finest;
    }
  }
}

class PlaceSource final : public SizeSource {
 public:
  PlaceSource(std::shared_ptr<const SizeSource> elsewhere, std::vector<PlaceSize> places, ScanTable scans)
      : elsewhere_(std::move(elsewhere)), places_(std::move(places)), scans_(std::move(scans)) {
    finest_mm_ = elsewhere_->finest_mm();
    constexpr double kShare = 0.5;  // so that nodes of a grid fall into the place
    for (const PlaceSize& one : places_) finest_mm_ = std::min(finest_mm_, kShare * finest_of(one.place, scans_));
  }

  void sizes_at(std::span<const SizePlace> places, std::span<double> sizes) const override {
    elsewhere_->sizes_at(places, sizes);
    for (std::size_t i = 0; i < places.size(); ++i) {
      bool is_set = false;
      for (const PlaceSize& one : places_) {
        if (!is_point_in(one.place, scans_, places[i].point)) continue;
        sizes[i] = is_set ? std::min(sizes[i], one.size_mm) : one.size_mm;
        is_set = true;
      }
    }
  }
  bool needs_depth() const override { return elsewhere_->needs_depth(); }
  double finest_mm() const override { return finest_mm_; }

 private:
  std::shared_ptr<const SizeSource> elsewhere_;
  std::vector<PlaceSize> places_;
  ScanTable scans_;
  double finest_mm_;
};

}  // namespace

std::shared_ptr<const SizeSource> place_source(std::shared_ptr<const SizeSource> elsewhere,
                                               const std::vector<PlaceSize>& places, Progress& progress,
                                               std::vector<std::string>& files) {
  ScanTable scans;
  for (const PlaceSize& one : places) {
    for (const std::string& name : scans_of(one.place)) {
      if (scans.contains(name)) continue;
      constexpr bool kMayBeConstant = true;
      Scan scan = read_scan(name, progress, kMayBeConstant);
      if (progress.cancelled()) return nullptr;
      for (const std::string& file : input_files(name)) files.push_back(file);
      scans.emplace(name, ScanValues(std::move(scan)));
    }
  }
  return std::make_shared<PlaceSource>(std::move(elsewhere), places, std::move(scans));
}

void check_covers(const Box& covered, const Box& object, const std::string& file) {
  for (int axis = 0; axis < 3; ++axis) {
    if (covered.min[axis] <= object.max[axis] && covered.max[axis] >= object.min[axis]) continue;
    throw Error(Fault::input, "input.size_image",
                file + ": the image of sizes is elsewhere than the object: along axis " + std::string(1, "xyz"[axis]) +
                    " it covers " + number_text(covered.min[axis], 5) + " to " + number_text(covered.max[axis], 5) +
                    " mm, the object " + number_text(object.min[axis], 5) + " to " + number_text(object.max[axis], 5) +
                    " mm",
                "check its origin and directions");
  }
}

std::shared_ptr<const SizeSource> read_source(const SizeRequest& request, const Box& object, Progress& progress,
                                              std::vector<std::string>& files) {
  if (request.kind == SizeRequest::Kind::number) return std::make_shared<UniformSource>(request.size_mm);
  if (request.image.empty()) return request.source;
  constexpr bool kMayBeConstant = true;
  const Scan scan = read_scan(request.image, progress, kMayBeConstant);
  if (progress.cancelled()) return nullptr;
  for (const std::string& file : input_files(request.image)) files.push_back(file);
  const Vec last{scan.size[0] - 0.5, scan.size[1] - 0.5, scan.size[2] - 0.5};
  check_covers(scan.frame.world_box({-0.5, -0.5, -0.5}, last), object, request.image);
  return std::make_shared<SizeImage>(scan);
}

}  // namespace scantet
