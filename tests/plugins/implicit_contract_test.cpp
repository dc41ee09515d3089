#include "contract/plugin_case.h"

namespace scantet {
namespace {

DomainCase named(const std::string& name) {
  return plugin_case(name, SCANTET_IMPLICIT_PLUGIN, "implicit:" + name);
}
DomainCase formula(const std::string& name, const std::string& text, const std::string& bounds) {
  return plugin_case(name, SCANTET_IMPLICIT_PLUGIN, "implicit:" + text, {{"bounds", bounds}});
}

INSTANTIATE_TEST_SUITE_P(
    Implicit, DomainContract,
    ::testing::Values(named("sphere"), named("ellipsoid"), named("torus"), named("tanglecube"), named("gyroid"),
                      named("heart"), formula("Cube", "max(abs(x), abs(y), abs(z)) - 1", "-1.5,-1.5,-1.5,1.5,1.5,1.5"),
                      formula("FarAway", "(x-1e5)^2 + y^2 + (z+3e4)^2 - 1", "99998,-2,-30002,100002,2,-29998"),
                      formula("Ripples", "sqrt(x^2+y^2+z^2) - 1 - 0.1*sin(20*x)*cos(17*y)*exp(-z^2)", "-2,-2,-2,2,2,2"),
                      formula("Blobs", "-log(1/(x^2+y^2+z^2+0.1) + 1/((x-2)^2+y^2+z^2+0.1))", "-6,-6,-6,6,6,6")),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace scantet
