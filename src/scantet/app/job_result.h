// How a job ended.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/plugin/input_info.h"
#include "scantet/report/report.h"

namespace SCANTET_PROGRAM_API scantet {

/// How a job ended. What went wrong beyond repair is an Error instead.
struct JobResult {
  bool cancelled = false;  ///< nothing was written; the rest is empty
  Report report;
  std::vector<std::string> written;   ///< files, meshes first
  std::vector<std::string> notes;     ///< worth knowing: the size chosen by default, expected trouble
  std::vector<std::string> findings;  ///< bounds unmet and faults of the mesh; empty: all is as asked for
  std::vector<InfoSection> plan;      ///< of a job that is only to be planned: then there is no mesh
  TetMesh mesh;                       ///< what was written; no tets if there is none
  std::string provenance;             ///< MeshWriteOptions::provenance of the files
};

}  // namespace scantet
