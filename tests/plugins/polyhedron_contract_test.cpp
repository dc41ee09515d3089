#include "contract/plugin_case.h"
#include "surface_files.h"
#include "temporary_file.h"

namespace scantet {
namespace {

DomainCase surface(const std::string& name, const std::string& extension, std::string (Facets::*format)() const,
                   const Facets& facets) {
  const auto make = [=] {
    const test::TemporaryFile file("contract_" + name + extension, (facets.*format)());
    return open_with_plugin(SCANTET_POLYHEDRON_PLUGIN, file.path());
  };
  return {name, make};
}

INSTANTIATE_TEST_SUITE_P(Polyhedron, DomainContract,
                         ::testing::Values(surface("CubeOff", ".off", &Facets::off, cube(1)),
                                           surface("CubesObj", ".obj", &Facets::obj, cubes()),
                                           surface("CubesStl", ".stl", &Facets::stl, cubes()),
                                           surface("CubesPly", ".ply", &Facets::ply, cubes()),
                                           surface("RingOff", ".off", &Facets::off, ring())),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace scantet
