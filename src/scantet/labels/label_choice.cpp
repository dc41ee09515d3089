// A text of digits, commas, hyphens and spaces is a list; any other is the name of a table.
#include "scantet/labels/label_choice.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>

#include "scantet/base/ascii_text.h"
#include "scantet/base/error.h"
#include "scantet/base/regular_file.h"
#include "scantet/labels/label_words.h"

namespace scantet {
namespace {

constexpr std::int64_t kLargest = std::numeric_limits<Region>::max();

[[noreturn]] void refuse(const std::string& place, const std::string& fault) {
  throw Error(Fault::usage, "usage.labels", place + ": " + fault,
              "--labels takes all, a list such as 1,3,7-12, or a table of lines such as \"17 Hippocampus\"");
}

/// "7" or "7-12".
std::optional<LabelRange> range_in(const std::string& text) {
  const std::size_t hyphen = text.find('-');
  const auto first = whole_number(text.substr(0, hyphen));
  const auto last = hyphen == std::string::npos ? first : whole_number(text.substr(hyphen + 1));
  if (!first || !last || *first < 0 || *last < *first || *last > kLargest) return std::nullopt;
  return LabelRange{*first, *last};
}

LabelChoice read_list(const std::string& place, const std::string& text) {
  LabelChoice choice{false, {}};
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::vector<std::string> words = words_of(text.substr(begin, end - begin));
    const std::string item = words.size() == 1 ? words.front() : text.substr(begin, end - begin);
    auto range = range_in(item);
    if (!range) refuse(place, "\"" + item + "\" is no label and no range of labels");
    range->place = place + ": " + item;
    choice.ranges.push_back(*range);
    begin = end + 1;
  }
  return choice;
}

LabelRange read_line(const std::string& place, const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  auto range = range_in(words[0]);
  if (!range) refuse(place, "\"" + words[0] + "\" is no label and no range of labels");
  range->place = place;
  std::size_t next = 1;
  if (words.size() > 1) {
    if (const auto becomes = whole_number(words[1])) {
      if (*becomes < 0 || *becomes > kLargest) refuse(place, words[1] + " is no label");
      range->becomes = static_cast<Region>(*becomes);
      ++next;
    }
  }
  for (std::size_t n = next; n < words.size(); ++n) range->name += (n == next ? "" : " ") + words[n];
  const std::string& name = range->name;
  if (name.size() > 1 && name.front() == '"' && name.back() == '"') range->name = name.substr(1, name.size() - 2);
  if (!range->becomes && !range->name.empty() && range->first != range->last) {
    refuse(place, "several labels, one name, and no new label for them");
  }
  return *range;
}

LabelChoice read_table(const std::string& place, const std::string& path) {
  check_regular_file(path);
  std::ifstream file(path);
  if (!file) refuse(place, "there is no table of labels '" + path + "'");
  LabelChoice choice{false, {}};
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    choice.ranges.push_back(read_line(path + ":" + std::to_string(number), line));
  }
  if (choice.ranges.empty()) refuse(place, "the table '" + path + "' has no labels");
  return choice;
}

void check_once(const LabelChoice& choice) {
  std::vector<LabelRange> ranges = choice.ranges;
  std::stable_sort(ranges.begin(), ranges.end(),
                   [](const LabelRange& a, const LabelRange& b) { return a.first < b.first; });
  for (std::size_t n = 1; n < ranges.size(); ++n) {
    if (ranges[n].first <= ranges[n - 1].last) {
      refuse(ranges[n].place, "the label " + std::to_string(ranges[n].first) + " is chosen twice");
    }
  }
}

/// That the image has that label, and that all labels are meshed but it.
void check_background(std::int64_t background, const LabelChoice& choice, const std::vector<LabelCount>& labels) {
  const std::string place = "--background: " + std::to_string(background);
  if (!choice.all) {
    throw Error(Fault::usage, "usage.no_effect",
                place + ": it does nothing here: --labels chooses, and what it does not choose is background",
                "leave it out, or --labels");
  }
  const auto is_it = [&](const LabelCount& count) { return count.label == background; };
  if (std::any_of(labels.begin(), labels.end(), is_it)) return;
  throw Error(Fault::usage, "usage.labels", place + ": no voxel of the image has that label",
              "scantet info lists the labels of an image");
}

}  // namespace

bool is_label_table(const std::string& text) {
  return text != "all" && text.find_first_not_of("0123456789,- ") != std::string::npos;
}

LabelChoice read_label_choice(const std::string& place, const std::string& text) {
  if (text.empty() || text == "all") return {};
  LabelChoice choice = is_label_table(text) ? read_table(place, text) : read_list(place, text);
  check_once(choice);
  return choice;
}

LabelSettings settings_of(const LabelChoice& choice, const LabelTable& table, const std::vector<LabelCount>& labels,
                          std::int64_t background) {
  if (background != 0) check_background(background, choice, labels);
  LabelSettings settings;
  settings.background = background;
  settings.keep_others = choice.all;
  const auto name = [&](Region region, const std::string& text, const std::string& place) {
    if (text.empty() || region == kOutside) return;
    const auto [known, is_new] = settings.names.emplace(region, text);
    if (!is_new && known->second != text) {
      refuse(place, "region " + std::to_string(region) + " is called " + known->second + " and " + text);
    }
  };
  for (const LabelRange& range : choice.ranges) {
    const auto from = std::lower_bound(labels.begin(), labels.end(), range.first,
                                       [](const LabelCount& count, std::int64_t label) { return count.label < label; });
    if (from == labels.end() || from->label > range.last) {
      throw Error(Fault::usage, "usage.labels",
                  range.place + ": no voxel of the image has " +
                      (range.first == range.last ? "that label" : "a label of that range"),
                  "scantet info lists the labels of an image");
    }
    for (auto label = from; label != labels.end() && label->label <= range.last; ++label) {
      const Region region = range.becomes.value_or(static_cast<Region>(label->label));
      settings.region_of[label->label] = region;
      name(region, range.name, range.place);
    }
  }
  const std::vector<std::int64_t> values = labels_of(labels);
  const std::vector<Region> regions = regions_of_labels(values, settings);
  std::map<Region, int> sharing;
  for (const Region region : regions) ++sharing[region];
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (regions[n] == kOutside) continue;
    const auto color = table.colors.find(values[n]);
    if (color != table.colors.end()) settings.colors.emplace(regions[n], color->second);
    const auto known = table.names.find(values[n]);
    if (known == table.names.end() || sharing[regions[n]] > 1) continue;
    settings.names.emplace(regions[n], known->second);
  }
  return settings;
}

}  // namespace scantet
