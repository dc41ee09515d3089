// Jobs on existing meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/base/api.h"
#include "scantet/base/progress.h"

namespace SCANTET_PROGRAM_API scantet {

/// What was found in meshes.
struct MeshFindings {
  bool cancelled = false;             ///< nothing was written; the rest is empty
  std::vector<Report> reports;        ///< one a mesh, in their order
  std::vector<std::string> written;   ///< files
  std::vector<std::string> findings;  ///< faults; with the mesh's name in front if there are several; empty: none
};

/// Reads meshes, measures and audits them, and writes the reports, each of all meshes side by side. A mesh stands
/// alone: boundary vertices are not compared with a scan. wave_speed_m_per_s: for the stable time steps. Throws Error
/// as read_mesh, check_outputs and write_report do.
MeshFindings report_on_meshes(const std::vector<std::string>& meshes, const std::vector<std::string>& reports,
                              Progress& progress, double wave_speed_m_per_s = kWaveSpeedMPerS);

/// What a mesh file has beside the straight tets.
struct MeshBeside {
  TetMesh second_order;               ///< the mesh as it was read; empty if it is of first order
  std::vector<std::string> left_out;  ///< that was not read, as read_mesh() tells it
};

/// Of what was not read so much is told.
inline constexpr std::size_t kShownUnread = 8;

/// Reads a mesh file into `mesh`, measures and audits it, as report_on_meshes() does. Of a mesh of second order `mesh`
/// gets the straight tets. beside: gets the rest; may be null.
Report report_on_mesh(const std::string& file, double wave_speed_m_per_s, TetMesh& mesh, Progress& progress,
                      MeshBeside* beside = nullptr);

/// Reads a mesh and writes it in another format. also_read: files that `to` must not replace, beside `from`. Return:
/// notes on what of `from` is not in `to`; none if cancelled, and nothing is written then. Throws Error as read_mesh,
/// check_outputs and write_mesh do.
std::optional<std::vector<std::string>> convert_mesh(const std::string& from, const std::string& to, Space space,
                                                     Progress& progress,
                                                     const std::vector<std::string>& also_read = {});

}  // namespace scantet
