#include "contract/domain_contract.h"
#include "scantet/domain/analytic.h"

namespace scantet {

INSTANTIATE_TEST_SUITE_P(Analytic, DomainContract,
                         ::testing::Values(DomainCase{"Sphere",
                                                      [] {
                                                        return make_sphere({1, 2, 3}, 10);
                                                      }},
                                           DomainCase{"Shell", [] { return make_shell({}, 5, 10); }},
                                           DomainCase{"Torus",
                                                      [] {
                                                        return make_torus({5, 0, 0}, 10, 3);
                                                      }},
                                           DomainCase{"Tanglecube", [] { return make_tanglecube(); }},
                                           DomainCase{"TwoSpheres", [] { return make_two_spheres(5, 0.1); }}),
                         [](const auto& test) { return test.param.name; });

}  // namespace scantet
