// The names and the bounds; what they open is ImplicitDomain.
#include <charconv>
#include <optional>

#include "implicit_domain.h"
#include "scantet/base/error.h"
#include "scantet/plugin/plugin.h"

namespace implicit {
namespace {

using scantet::Error;
using scantet::Fault;
using scantet::number_text;

const std::string kPrefix = "implicit:";
constexpr double kShareOfBox = 0.04;
constexpr double kLeastSharp = 1;  // degrees
constexpr double kMostSharp = 180;

struct Surface {
  const char* name;
  const char* formula;
  scantet::Vec half;  // of the box around the origin, mm
};

// The gyroid is cut off by a term that is next to nothing until r = 4 mm and more than the rest from 5.2 mm on: a
// smooth end, where min with a ball would leave an edge.
constexpr std::array kSurfaces{
    Surface{"sphere", "x^2 + y^2 + z^2 - 1", {1.25, 1.25, 1.25}},
    Surface{"ellipsoid", "(x/2)^2 + y^2 + (z/0.75)^2 - 1", {2.5, 1.25, 1}},
    Surface{"torus", "(x^2 + y^2 + z^2 + 0.84)^2 - 4*(x^2 + y^2)", {1.75, 1.75, 0.5}},
    Surface{"tanglecube", "x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8", {3, 3, 3}},
    Surface{"gyroid", "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x) + ((x^2 + y^2 + z^2)/25)^8", {6, 6, 6}},
    Surface{"heart", "(x^2 + 2.25*y^2 + z^2 - 1)^3 - x^2*z^3 - 0.1125*y^2*z^3", {1.5, 1, 1.5}}};

scantet::Box parse_bounds(const std::string& text) {
  const auto refuse = [&](const std::string& what) -> void {
    throw Error(Fault::usage, "usage.value", "--bounds: \"" + text + "\" " + what,
                "--bounds x,y,z,X,Y,Z: the least and the greatest corner, mm, e.g. -3,-3,-3,3,3,3");
  };
  std::array<double, 6> numbers{};
  const char* next = text.data();
  const char* end = text.data() + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (next == end || *next++ != ',')) refuse("is not six numbers with commas between them");
    const auto [stop, code] = std::from_chars(next, end, numbers[i]);
    if (code != std::errc{} || !std::isfinite(numbers[i])) refuse("is not six numbers with commas between them");
    next = stop;
  }
  if (next != end) refuse("goes on after six numbers");
  const scantet::Box box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] < box.max[axis])) refuse(std::string("has no extent along ") + "xyz"[axis]);
  }
  return box;
}

class ImplicitPlugin final : public scantet::InputPlugin {
 public:
  std::string name() const override { return "implicit"; }
  std::string description() const override;
  int can_open(const std::string& input) const override { return input.starts_with(kPrefix) ? 100 : 0; }
  void declare_options(scantet::OptionSet& options) override;
  scantet::OpenedDomain open(const std::string& input, scantet::Progress& progress) override;
  std::vector<scantet::InfoSection> info(const std::string& input, scantet::Progress& progress) override;

 private:
  struct Object {
    std::string formula;
    std::unique_ptr<ImplicitDomain> domain;
  };
  /// No domain if cancelled.
  Object make(const std::string& input, const scantet::Progress& progress) const;
  static double default_size_mm(const scantet::Box& box) {
    return kShareOfBox * std::min({box.extent().x, box.extent().y, box.extent().z});
  }

  std::string bounds_;
  std::optional<double> sharp_degrees_;
};

std::string ImplicitPlugin::description() const {
  std::string names;
  for (const Surface& surface : kSurfaces) names += (names.empty() ? "" : ", ") + std::string(surface.name);
  return "implicit:FORMULA, where a formula of x, y and z is negative, or implicit:NAME (" + names + ")";
}

void ImplicitPlugin::declare_options(scantet::OptionSet& options) {
  options.add("bounds", bounds_,
              {"Formula", "x,y,z,X,Y,Z", "a box",
               "Box to look for the object in, least corner and greatest corner in mm; the formula must be positive on "
               "its faces.",
               0, "required for a formula; the named surfaces bring theirs"});
  options.add("sharp-edges", sharp_degrees_, scantet::Range::between(kLeastSharp, kMostSharp),
              {"Formula", "DEG", "an angle in degrees",
               "Has the mesh follow the edges that min, max and abs make where two smooth surfaces meet, if the "
               "directions that these face differ by so many degrees or more somewhere along the edge, and the corners "
               "where three meet; scantet info counts both.",
               0, "no edge is followed"});
}

ImplicitPlugin::Object ImplicitPlugin::make(const std::string& input, const scantet::Progress& progress) const {
  std::string formula = input.substr(kPrefix.size());
  std::optional<scantet::Box> box;
  for (const Surface& surface : kSurfaces) {
    if (formula != surface.name) continue;
    formula = surface.formula;
    box = {-1 * surface.half, surface.half};
    break;
  }
  Formula parsed(formula);
  if (!bounds_.empty()) box = parse_bounds(bounds_);
  if (!box) {
    throw Error(Fault::usage, "usage.bounds_missing",
                "--bounds is missing: " + input + " needs a box to be looked for in",
                "give --bounds x,y,z,X,Y,Z, in mm");
  }
  try {
    auto domain = std::make_unique<ImplicitDomain>(std::move(parsed), *box, progress);
    if (sharp_degrees_) domain->set_creases(find_creases(formula, *box, *sharp_degrees_, progress));
    if (progress.cancelled()) domain.reset();
    return {std::move(formula), std::move(domain)};
  } catch (const Error& error) {
    const std::string what = error.what();  // ends with the remedy
    throw Error(error.fault(), error.code(), input + ": " + what.substr(0, what.size() - error.remedy().size() - 2),
                error.remedy());
  }
}

scantet::OpenedDomain ImplicitPlugin::open(const std::string& input, scantet::Progress& progress) {
  Object object = make(input, progress);
  scantet::OpenedDomain opened;
  if (object.domain == nullptr) return opened;
  opened.default_size_mm = default_size_mm(object.domain->bounds());
  opened.default_size_reason = number_text(kShareOfBox) + " x the shortest edge of the box";
  opened.domain = std::move(object.domain);
  return opened;
}

std::vector<scantet::InfoSection> ImplicitPlugin::info(const std::string& input, scantet::Progress& progress) {
  const Object object = make(input, progress);
  if (object.domain == nullptr) return {};
  const scantet::Box box = object.domain->bounds();
  const Interval values = object.domain->sampled_values();
  const auto corner = [](const scantet::Point& p) { return std::vector<double>{p.x, p.y, p.z}; };
  std::vector<scantet::InfoSection> sections{
      {"implicit",
       "Implicit surface",
       {{"formula", "formula", object.formula, ""},
        {"box_min_mm", "box from", corner(box.min), "mm"},
        {"box_max_mm", "box to", corner(box.max), "mm"},
        {"values", "least and greatest value sampled", std::vector<double>{values.lo, values.hi}, ""},
        {"default_size_mm", "default size", default_size_mm(box), "mm"}}}};
  if (sharp_degrees_) {
    const auto count = [](auto number) { return static_cast<std::int64_t>(number); };
    auto& entries = sections.front().entries;
    entries.push_back({"sharp_curves", "curves of sharp edges", count(object.domain->curves().size()), ""});
    entries.push_back({"sharp_corners", "corners of these", count(object.domain->corners().size()), ""});
  }
  return sections;
}

}  // namespace
}  // namespace implicit

SCANTET_PLUGIN(implicit::ImplicitPlugin);
