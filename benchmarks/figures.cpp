// Peak memory is the high-water mark of the process. Linux lets a process lower its own mark to what it holds now, and
// the C library to give back what it holds for nothing; both are done before a measurement.
#include "figures.h"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <limits>
#include <set>
#include <string_view>

#include "scantet/check/audit.h"
#include "scantet/io/sha256.h"
#include "scantet/quality/quality.h"

namespace scantet::bench {
namespace {

std::uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t lowered_peak_bytes() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5\n";
  return peak_resident_bytes();
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

template <class T>
std::string checksum(const std::vector<T>& values) {
  return sha256_text({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace

Meter::Meter() : resident_before_(lowered_peak_bytes()), cpu_before_s_(cpu_seconds()) {}

void Meter::read(Figures& figures) const {
  figures.wall_s = wall_.seconds();
  figures.seconds = figures.wall_s;
  figures.cpu_s = cpu_seconds() - cpu_before_s_;
  figures.peak_bytes = peak_resident_bytes() - resident_before_;
}

void describe(const TetMesh& mesh, Figures& figures) {
  constexpr std::size_t kUnder10 = 1;  // of kSliverDeg
  const QualitySummary quality = measure_quality(mesh);
  figures.vertices = mesh.vertices.size();
  figures.boundary_vertices =
      mesh.vertices.size() - static_cast<std::size_t>(std::count_if(mesh.strata.begin(), mesh.strata.end(),
                                                                    [](const Stratum& s) { return !s.on_boundary(); }));
  figures.tets = mesh.tets.size();
  const AuditReport topology = audit(mesh, nullptr);
  figures.components = topology.components.size();
  figures.cavities = topology.cavities;
  figures.regions = std::set<Region>(mesh.tet_regions.begin(), mesh.tet_regions.end()).size();
  figures.min_dihedral_deg = quality.min_dihedral_deg();
  figures.tets_under_10_deg = quality.tets_under_deg[kUnder10];
  figures.max_radius_edge = std::min(quality.max_radius_edge(), std::numeric_limits<double>::max());  // JSON has no inf
  figures.mesh_sha256 = sha256_text(checksum(mesh.vertices) + checksum(mesh.tets) + checksum(mesh.boundary_facets));
}

}  // namespace scantet::bench
