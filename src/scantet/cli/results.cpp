// Tables go to standard output, what needs attention to standard error.
#include "scantet/cli/results.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "scantet/app/info.h"
#include "scantet/cli/command.h"
#include "scantet/cli/print.h"
#include "scantet/report/report_forms.h"

namespace scantet {
namespace {

// The first locale variable that is set decides, as in setlocale.
bool locale_is_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    const std::string text = value;
    return text.find("UTF-8") != std::string::npos || text.find("utf8") != std::string::npos;
  }
  return false;
}

TextStyle terminal_style() {
  constexpr int kNarrowest = 40;
  constexpr int kWidest = 120;
  TextStyle style;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    style.width = std::clamp(static_cast<int>(size.ws_col), kNarrowest, kWidest);
  }
  style.unicode = locale_is_utf8();
  return style;
}

void print_written(const std::vector<std::string>& files) {
  for (const std::string& file : files) print("wrote " + file + "\n");
}

int print_unmet(const std::vector<std::string>& findings) {
  finish_printing();
  for (const std::string& finding : findings) print_error_line("unmet: " + finding);
  return findings.empty() ? kExitDone : kExitUnmet;
}

}  // namespace

int print_result(const JobResult& result, bool quiet) {
  if (!quiet) {
    print(info_text(result.plan));
    if (result.report.mesh) print(text_report(result.report, terminal_style()));
    print_written(result.written);
    for (const std::string& note : result.notes) print_error_line("note: " + note);
  }
  return print_unmet(result.findings);
}

int print_findings(const MeshFindings& found) {
  const bool several = found.reports.size() > 1;
  for (std::size_t i = 0; i < found.reports.size(); ++i) {
    if (several) print((i == 0 ? "" : "\n") + found.reports[i].input->path + ":\n");
    print(text_report(found.reports[i], terminal_style()));
  }
  print_written(found.written);
  return print_unmet(found.findings);
}

}  // namespace scantet
