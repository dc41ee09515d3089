#include "contract/domain_contract.h"
#include "scantet/cuts/cut_domain.h"
#include "scantet/cuts/cut_text.h"
#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

DomainCase cut_case(const std::string& name, const std::function<std::unique_ptr<Domain>()>& make,
                    const std::vector<std::string>& cuts) {
  return {name, [=] {
            std::vector<CutPlane> planes;
            for (const std::string& text : cuts) read_cut("--cut", text, planes);
            return make_cut_domain(make(), planes, 0.5, 0.5);
          }};
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Cut, DomainContract,
                         ::testing::Values(cut_case("Sphere",
                                                    [] {
                                                      return make_sphere({1, 2, 3}, 10);
                                                    },
                                                    {"x < 5"}),
                                           cut_case("Shell", [] { return make_shell({}, 5, 10); }, {"x + 2y - z < 3"}),
                                           cut_case("Torus",
                                                    [] {
                                                      return make_torus({5, 0, 0}, 10, 3);
                                                    },
                                                    {"0 < x + 0.1y < 9", "z > -1"}),
                                           cut_case("TwoSpheres", [] { return make_two_spheres(5, 0.1); }, {"x < 1"})),
                         [](const auto& test) { return test.param.name; });

}  // namespace scantet
