// What the forms of a report share, and the choice among them.
#include "scantet/io/report.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <ostream>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"

namespace scantet {
namespace {

template <typename Number>
ReportValue number_of(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return text;
  return value;
}

ReportValue value_of(const Option& option) {
  const std::vector<std::string> texts = option.read();
  if (option.kind == OptionKind::list) return texts;
  if (texts.empty()) return nullptr;
  switch (option.kind) {
    case OptionKind::flag:
      return texts.front() == "true";
    case OptionKind::number:
      return number_of<double>(texts.front());
    case OptionKind::integer:
      return number_of<std::uint64_t>(texts.front());
    default:
      return texts.front();
  }
}

}  // namespace

ReportMesh report_mesh(const TetMesh& mesh, const QualitySummary& quality) {
  const auto flagged = std::count_if(mesh.on_boundary.begin(), mesh.on_boundary.end(), [](auto f) { return f != 0; });
  return {mesh.vertices.size(), mesh.tets.size(), mesh.boundary_facets.size(), static_cast<std::uint64_t>(flagged),
          quality.total_volume_mm3};
}

std::vector<ReportOption> report_options(const OptionSet& options) {
  std::vector<ReportOption> report;
  for (const Option& option : options.options()) report.push_back({option.name, value_of(option)});
  return report;
}

const std::vector<std::string>& report_extensions() {
  static const std::vector<std::string> extensions{".json", ".csv"};
  return extensions;
}

void write_report(const Report& report, const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::string text;
  if (extension == ".json") {
    text = json_report(report);
  } else if (extension == ".csv") {
    text = csv_report(report);
  } else {
    throw Error(Fault::usage, "usage.format",
                path + ": " + (extension.empty() ? "no extension" : "unknown extension " + extension) + " for a report",
                "the extension chooses the format: .json or .csv");
  }
  write_file(path, [&](std::ostream& out) { out << text; });
}

}  // namespace scantet
