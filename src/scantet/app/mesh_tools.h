// Jobs on meshes that are there already.
#pragma once

#include <string>
#include <vector>

#include "scantet/app/job.h"

namespace scantet {

/// Reads a mesh, measures and audits it, and writes the reports. The mesh stands alone: boundary vertices are not
/// compared with a scan.
/// Throws Error as read_mesh, check_outputs and write_report do.
JobResult report_on_mesh(const std::string& mesh, const std::vector<std::string>& reports, Progress& progress);

/// Reads a mesh and writes it in another format. Return: false if cancelled; nothing is written then.
/// Throws Error as read_mesh, check_outputs and write_mesh do.
bool convert_mesh(const std::string& from, const std::string& to, Space space, Progress& progress);

}  // namespace scantet
