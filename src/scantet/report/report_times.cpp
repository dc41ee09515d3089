// Seconds with two digits behind the point: less than that nobody waits for.
#include "scantet/report/numbers_impl.h"
#include "scantet/report/report_times_impl.h"

namespace scantet {
namespace {

std::string seconds_text(double seconds) {
  return printed(seconds, std::chars_format::fixed, 2);
}

}  // namespace

std::string text_of(const ReportTiming& timing) {
  std::string parts;
  timing.for_each_part([&](const char* stage, const std::optional<double>& seconds) {
    if (seconds) parts += std::string(parts.empty() ? "" : ", ") + stage + " " + seconds_text(*seconds);
  });
  if (!timing.total) return parts + (parts.empty() ? "" : " s");
  return seconds_text(*timing.total) + " s" + (parts.empty() ? "" : " (" + parts + ")");
}

std::string text_of(const std::vector<StageAccount>& stages) {
  std::string text;
  for (const StageAccount& s : stages) {
    text += (text.empty() ? "" : ", ") + s.stage + " " + seconds_text(s.seconds) + " s";
    if (s.points > 0) text += " (" + counted(s.points, "point", "points") + ")";
  }
  return text;
}

std::string text_of(const std::vector<PhaseAccount>& phases) {
  std::string text;
  const std::string* stage = nullptr;
  for (const PhaseAccount& p : phases) {
    const bool is_same = stage != nullptr && *stage == p.stage;
    text += is_same ? ", " : (stage == nullptr ? "" : "; ") + p.stage + ": ";
    text += p.part + " " + seconds_text(p.seconds);
    stage = &p.stage;
  }
  return text + (text.empty() ? "" : " s");
}

}  // namespace scantet
