// The function is applied to the voxels, and the result is interpolated, as Bonemat's third version does.
#include "scantet/materials/tet_means.h"

#include <memory>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/fields/scan_field.h"

namespace scantet {
namespace {

Scan mapped(const Scan& scan, const std::function<double(double)>& of_value) {
  std::vector<double> values(static_cast<std::size_t>(scan.voxel_count()));
  std::visit(
      [&](const auto* voxels) {
        parallel_for(values.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) values[i] = of_value(static_cast<double>(voxels[i]));
        });
      },
      scan.voxels);
  Scan result = scan;
  const auto kept = std::make_shared<const std::vector<double>>(std::move(values));
  result.voxels = VoxelPointer{kept->data()};
  result.owner = kept;
  return result;
}

}  // namespace

std::vector<double> tet_means(const TetMesh& mesh, const ScanValues& scan,
                              const std::function<double(double)>& of_value) {
  return scan_field(mesh, mapped(scan.scan(), of_value)).values;
}

}  // namespace scantet
