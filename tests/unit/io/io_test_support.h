// Meshes and folders for the tests of io/.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/io/mesh_io.h"

namespace scantet {

inline void PrintTo(const MeshFormat& format, std::ostream* out) {
  *out << format.extension;
}

/// A folder of its own for each test, removed at the end.
class IoTest : public testing::Test {
 protected:
  IoTest() {
    std::string name = (std::filesystem::temp_directory_path() / "scantet_io_XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) folder_ = name;
  }
  ~IoTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  void SetUp() override { ASSERT_FALSE(folder_.empty()); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files_in_folder() const {
    const std::filesystem::directory_iterator begin(folder_);
    return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator()));
  }

  std::filesystem::path folder_;
};

inline std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The file, or the files in the folder by name.
inline std::vector<std::string> files_at(const std::string& path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Of all files that are written for this path, one after the other.
inline std::string content_of_mesh(const std::string& path) {
  std::string content;
  for (const std::string& file : mesh_files(path)) {
    for (const std::string& part : files_at(file)) content += content_of(part);
  }
  return content;
}

inline void put_content(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// The unit cube, scaled to 10 mm and moved, as n³ cells of six tets each, the inner vertices moved a little so that
/// coordinates have all their digits. The cells on the +x half are of region `second`.
inline TetMesh make_cube(int n, Region first = 1, Region second = 1) {
  TetMesh mesh;
  const auto id = [n](int i, int j, int k) { return static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i); };
  const auto inner = [n](int i) { return i > 0 && i < n; };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const double shift = inner(i) && inner(j) && inner(k) && 2 * i != n ? 0.1 * std::sin(i + 3.7 * j + 5.3 * k) : 0;
        mesh.vertices.push_back({10 * (i + shift) / n - 4, 10 * (j + shift) / n + 1e-5, 10 * (k - shift) / n + 100});
      }
    }
  }
  constexpr int kPaths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        for (int path = 0; path < 6; ++path) {
          int at[3] = {i, j, k};
          Tet tet{};
          for (std::size_t corner = 0; corner < 4; ++corner) {
            tet[corner] = id(at[0], at[1], at[2]);
            if (corner < 3) ++at[kPaths[path][corner]];
          }
          if (path >= 3) std::swap(tet[1], tet[2]);  // odd permutations turn the other way
          mesh.tets.push_back(tet);
          mesh.tet_regions.push_back(2 * i < n ? first : second);
        }
      }
    }
  }
  build_boundary(mesh);
  return mesh;
}

inline double volume_mm3(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) {
    sum += orientation_mm3(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]) / 6;
  }
  return sum;
}

inline bool all_positive(const TetMesh& mesh) {
  for (const Tet& t : mesh.tets) {
    if (!(orientation_mm3(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]) > 0)) {
      return false;
    }
  }
  return true;
}

/// Runs `call` and returns its Error; fails the test if there is none.
template <typename Call>
Error error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no Error was thrown";
  return {Fault::internal, "none", "none"};
}

}  // namespace scantet
