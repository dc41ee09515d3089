#include "scantet/app/model_options.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/io/input_files.h"
#include "scantet/places/place_items.h"
#include "scantet/reading/scan_reader.h"

namespace scantet {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

void read_scans(const std::vector<std::string>& names, ModelPlan& plan, Progress& progress) {
  for (const std::string& name : names) {
    if (plan.scans.count(name) > 0 || progress.cancelled()) continue;
    constexpr bool kMayBeConstant = true;
    Scan scan = read_scan(name, progress, kMayBeConstant);
    if (progress.cancelled()) return;
    for (const std::string& file : input_files(name)) plan.files.push_back(file);
    plan.scans.emplace(name, ScanValues(std::move(scan)));
  }
}

}  // namespace

void declare_model_options(OptionSet& options, ModelOptions& model) {
  options.add(
      "set", model.sets,
      {"Model", "NAME=PLACE", "a named place",
       "Names a place in the files, to be held or loaded: \"foot=z < -40\", \"load=facets: patch(outer) and "
       "ball(0, 0, 90, 12)\", \"hot=elements: scan(\"pet.nrrd\") > 3\". A place is a box, ball, cylinder, half-space, "
       "region, patch, curve, border, normal, nearest, scan or set, joined by and, or, minus and not "
       "(docs/places.md). Without nodes:, facets: or elements: the set holds all three."});
}

ModelPlan plan_model(const ModelOptions& options, Progress& progress) {
  ModelPlan plan;
  for (const std::string& text : options.sets) {
    plan.sets.push_back(read_named_place("--set", text));
    const std::string name = lower(plan.sets.back().name);
    const auto is_same = [&](const NamedPlace& other) { return lower(other.name) == name; };
    if (std::count_if(plan.sets.begin(), plan.sets.end(), is_same) > 1) {
      throw Error(Fault::usage, "usage.place", "--set: \"" + text + "\": another set is called " + name,
                  "give each set a name of its own; capitals make no difference");
    }
  }
  for (const NamedPlace& named : plan.sets) read_scans(scans_of(named.place), plan, progress);
  return plan;
}

void add_model(const ModelPlan& plan, TetMesh& mesh) {
  for (const NamedPlace& named : plan.sets) mesh.sets.push_back(items_in_place(mesh, named, plan.scans));
}

}  // namespace scantet
