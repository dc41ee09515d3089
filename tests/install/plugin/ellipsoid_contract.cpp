#include "contract/plugin_case.h"

namespace scantet {

INSTANTIATE_TEST_SUITE_P(Ellipsoid, DomainContract,
                         testing::Values(plugin_case("Egg", ELLIPSOID_PLUGIN, ELLIPSOID_FILE),
                                         plugin_case("Small", ELLIPSOID_PLUGIN, ELLIPSOID_FILE, {{"scale", "1e-3"}})),
                         [](const auto& test) { return test.param.name; });

}  // namespace scantet
