// Sizes as a user gives them: any function of the place, before they are made a sizing field.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_PROGRAM_API scantet {

/// Where a size is asked for.
struct SizePlace {
  Point point;      ///< in the domain or on its boundary, world mm
  double depth_mm;  ///< distance to the boundary; 0 if the source does not need it
  Region region;    ///< that the point is in, or on the boundary of
};

/// Throws Error (usage.size): the message says that `text`, given to `option`, gives size_mm at the place, and that
/// this is no size. depth_matters: whether it names the depth, too.
[[noreturn]] void refuse_size(const std::string& option, const std::string& text, const SizePlace& place,
                              bool depth_matters, double size_mm);

/// Const methods may be called from many threads.
class SizeSource {
 public:
  virtual ~SizeSource() = default;
  /// Sets one size for each place, mm; infinity: no bound. A size that is not greater than 0 is refused by whoever
  /// asked.
  virtual void sizes_at(std::span<const SizePlace> places, std::span<double> sizes) const = 0;
  /// Whether the depth of places matters.
  virtual bool needs_depth() const { return false; }
  /// Over how short a way sizes may change, mm. Default: not known.
  virtual double finest_mm() const { return std::numeric_limits<double>::infinity(); }
};

/// The same size everywhere.
class UniformSource final : public SizeSource {
 public:
  explicit UniformSource(double size_mm) : size_mm_(size_mm) {}
  void sizes_at(std::span<const SizePlace>, std::span<double> sizes) const override {
    for (double& size : sizes) size = size_mm_;
  }

 private:
  double size_mm_;
};

/// Another source, but for some regions, which have a size each.
class RegionSource final : public SizeSource {
 public:
  /// elsewhere: not null. sizes_mm: by region, > 0.
  RegionSource(std::shared_ptr<const SizeSource> elsewhere, std::map<Region, double> sizes_mm)
      : elsewhere_(std::move(elsewhere)), sizes_mm_(std::move(sizes_mm)) {}
  void sizes_at(std::span<const SizePlace> places, std::span<double> sizes) const override {
    elsewhere_->sizes_at(places, sizes);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto own = sizes_mm_.find(places[i].region);
      if (own != sizes_mm_.end()) sizes[i] = own->second;
    }
  }
  bool needs_depth() const override { return elsewhere_->needs_depth(); }
  double finest_mm() const override { return elsewhere_->finest_mm(); }

 private:
  std::shared_ptr<const SizeSource> elsewhere_;
  std::map<Region, double> sizes_mm_;
};

}  // namespace scantet
