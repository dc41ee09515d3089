// Which labels of a segmentation are meshed, as a user says it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/labels/label_count.h"
#include "scantet/labels/label_names.h"
#include "scantet/labels/label_settings.h"

namespace scantet {

/// Labels in a row and what becomes of them.
struct LabelRange {
  std::int64_t first = 0;
  std::int64_t last = 0;            ///< ≥ first
  std::optional<Region> becomes{};  ///< none: each its own region
  std::string name{};               ///< of that region; empty: none given
  std::string place{};              ///< where it was said, for messages: "--labels: 7-12"
};

/// What --labels says.
struct LabelChoice {
  bool all = true;                   ///< all labels, each its own region
  std::vector<LabelRange> ranges{};  ///< those chosen, if not all
};

/// Reads "all" (so is nothing), a list such as "1,3,7-12", or the name of a table, a line "label name" or "label
/// new_label name" each (docs/formats.md, "Tables of labels"). place: opens messages, "--labels". Throws Error:
/// usage.labels (no list, and no file of that name; a line that makes no sense; a label twice; two names for a region).
LabelChoice read_label_choice(const std::string& place, const std::string& text);

/// Whether that text is the name of a table.
bool is_label_table(const std::string& text);

/// What the choice means for an image with these labels. table: of labels; a region has the name that the choice gives
/// it, or else that of its only label; and the colour of its first label that has one. background: the label that is
/// not meshed, if all others are. Throws Error: usage.labels (the choice names a label that the image has not, or the
/// background is one, and not 0), usage.no_effect (a background that is not 0 beside a choice).
LabelSettings settings_of(const LabelChoice& choice, const LabelTable& table, const std::vector<LabelCount>& labels,
                          std::int64_t background = 0);

}  // namespace scantet
