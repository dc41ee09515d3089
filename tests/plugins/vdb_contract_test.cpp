#include "contract/plugin_case.h"
#include "vdb_files.h"

namespace scantet {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

DomainCase grid_case(const std::string& name, const std::function<openvdb::GridBase::Ptr()>& make_grid,
                     const Options& options) {
  const auto make = [=] {
    const test::TemporaryFile file("contract_" + name + ".vdb");
    test::write_grids(file.path(), {make_grid()});
    return open_with_plugin(SCANTET_VDB_PLUGIN, file.path(), options);
  };
  return {name, make};
}

/// Nothing but noise, in leaves that are not all there.
openvdb::GridBase::Ptr noise() {
  openvdb::initialize();
  auto grid = openvdb::DoubleGrid::create(-1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  std::uniform_int_distribution<int> place(-20, 20);
  auto to = grid->getAccessor();
  for (int n = 0; n < 20'000; ++n)
    to.setValue(openvdb::Coord(place(random), place(random), place(random)), value(random));
  return grid;
}

openvdb::GridBase::Ptr half_floats() {
  auto grid = test::sphere_grid();
  grid->setSaveFloatAsHalf(true);
  return grid;
}

INSTANTIATE_TEST_SUITE_P(Vdb, DomainContract,
                         testing::Values(grid_case("LevelSet", test::sphere_grid, {}),
                                         grid_case("LevelSetOffZero", test::sphere_grid, {{"level", "1.3"}}),
                                         grid_case("HalfFloats", half_floats, {}),
                                         grid_case("FogSheared", [] { return test::fog_grid(); }, {{"level", "0.4"}}),
                                         grid_case("FogInt32", [] { return test::fog_grid<openvdb::Int32Grid>(1000); },
                                                   {{"level", "300"}}),
                                         grid_case("FogInt64", [] { return test::fog_grid<openvdb::Int64Grid>(1000); },
                                                   {{"level", "299.5"}}),
                                         grid_case("NoiseDouble", noise, {{"level", "0.1"}})),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace scantet
