// The GIL is taken once for each call, be it of one question or of many. Arrays go out as views of what the mesher
// asks, which Python may read while it answers.
#include "python_domain.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "scantet/base/error.h"

namespace scantet::python {
namespace {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Regions = py::array_t<Region, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// A copy: what Python keeps of it stays as it is.
py::array_t<double> points_array(const std::vector<Point>& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  std::copy_n(reinterpret_cast<const double*>(points.data()), 3 * points.size(), array.mutable_data());
  return array;
}
static_assert(sizeof(Point) == 3 * sizeof(double));

class PythonDomain final : public Domain {
 public:
  PythonDomain(std::shared_ptr<py::object> domain, std::shared_ptr<PythonFailure> failure)
      : domain_(std::move(domain)), failure_(std::move(failure)) {
    ask([&] {
      const auto bounds = domain_->attr("_bounds").cast<std::vector<double>>();
      box_ = {{bounds.at(0), bounds.at(1), bounds.at(2)}, {bounds.at(3), bounds.at(4), bounds.at(5)}};
      names_ = domain_->attr("_region_names").cast<std::map<Region, std::string>>();
    });
  }
  Box bounds() const override { return box_; }
  Region region_at(const Point& p) const override {
    Region region = kOutside;
    regions_at({&p, 1}, {&region, 1});
    return region;
  }
  void regions_at(std::span<const Point> points, std::span<Region> out) const override {
    if (points.empty()) return;
    ask([&] {
      const Regions regions = domain_->attr("_regions")(points_array({points.begin(), points.end()}));
      check(static_cast<std::size_t>(regions.size()) == points.size());
      std::copy_n(regions.data(), points.size(), out.begin());
    });
  }
  void crossings(const Segment& segment, Crossings& out) const override {
    CrossingLists lists;
    crossings_of({&segment, 1}, lists);
    out.assign(lists[0].begin(), lists[0].end());
  }
  void crossings_of(std::span<const Segment> segments, CrossingLists& out) const override {
    out.clear();
    if (!segments.empty()) ask([&] { take_crossings(segments, out); });
  }
  double default_size_mm() const {
    double size_mm = 0;
    ask([&] { size_mm = domain_->attr("_default_size").cast<double>(); });
    return size_mm;
  }
  std::string name_of_region(Region region) const override {
    const auto found = names_.find(region);
    return found == names_.end() ? std::string() : found->second;
  }

 private:
  template <class Questions>
  void ask(const Questions& questions) const {
    const py::gil_scoped_acquire gil;
    try {
      questions();
    } catch (const std::exception&) {
      failure_->keep();
      throw Error(Fault::input, "input.python", "the domain's Python code raised an exception");
    }
  }
  static void check(bool is_right) {
    if (!is_right) throw py::value_error("a domain gave arrays of the wrong shape");
  }
  void take_crossings(std::span<const Segment> segments, CrossingLists& out) const {
    std::vector<Point> starts;
    std::vector<Point> ends;
    for (const Segment& segment : segments) {
      starts.push_back(segment.source);
      ends.push_back(segment.target);
    }
    const py::tuple answer = domain_->attr("_crossings")(points_array(starts), points_array(ends));
    check(answer.size() == 4);
    const Indices of = answer[0].cast<Indices>();
    const Numbers places = answer[1].cast<Numbers>();
    const Regions from = answer[2].cast<Regions>();
    const Regions to = answer[3].cast<Regions>();
    const py::ssize_t count = of.size();
    check(places.size() == 3 * count && from.size() == count && to.size() == count);
    Crossings list;
    py::ssize_t next = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      list.clear();
      for (; next < count && of.data()[next] == static_cast<std::int64_t>(s); ++next) {
        const double* const p = places.data() + 3 * next;
        list.push_back({{p[0], p[1], p[2]}, from.data()[next], to.data()[next]});
      }
      out.append(list);
    }
    check(next == count);
  }

  std::shared_ptr<py::object> domain_;
  std::shared_ptr<PythonFailure> failure_;
  Box box_;
  std::map<Region, std::string> names_;
};

class PythonDomainPlugin final : public InputPlugin {
 public:
  PythonDomainPlugin(std::shared_ptr<py::object> domain, std::shared_ptr<PythonFailure> failure)
      : domain_(std::move(domain)), failure_(std::move(failure)) {}
  std::string name() const override { return "python"; }
  std::string description() const override { return "a domain of a Python program"; }
  int can_open(const std::string& input) const override { return input == kDomainInput ? 100 : 0; }
  void declare_options(OptionSet&) override {}
  OpenedDomain open(const std::string&, Progress&) override {
    OpenedDomain opened;
    auto domain = std::make_unique<PythonDomain>(domain_, failure_);
    opened.default_size_mm = domain->default_size_mm();
    opened.default_size_reason = "a twentieth of the shortest side of the domain's box";
    opened.domain = std::move(domain);
    return opened;
  }
  std::vector<InfoSection> info(const std::string&, Progress&) override { return {}; }

 private:
  std::shared_ptr<py::object> domain_;
  std::shared_ptr<PythonFailure> failure_;
};

}  // namespace

std::shared_ptr<py::object> shared_object(py::object object) {
  return {new py::object(std::move(object)), [](py::object* kept) {
            if (Py_IsInitialized() == 0) return;  // it has gone with the interpreter
            const py::gil_scoped_acquire gil;
            const std::unique_ptr<py::object> last(kept);
          }};
}

InputPluginFactory python_domain_plugin(py::object domain, std::shared_ptr<PythonFailure> failure) {
  return [kept = shared_object(std::move(domain)), failure = std::move(failure)] {
    return std::make_unique<PythonDomainPlugin>(kept, failure);
  };
}

}  // namespace scantet::python
