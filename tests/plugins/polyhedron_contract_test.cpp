#include "contract/plugin_case.h"
#include "surface_files.h"

namespace scantet {
namespace {

DomainCase surface(const std::string& name, const std::string& extension, std::string (Facets::*format)() const,
                   const Facets& facets) {
  const auto make = [=] {
    const std::string file = write_surface("contract_" + name + extension, (facets.*format)());
    auto domain = open_with_plugin(SCANTET_POLYHEDRON_PLUGIN, file);
    std::filesystem::remove(file);
    return domain;
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
