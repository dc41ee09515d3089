// A table of options that work only beside others; all other options always do something. Whether a boundary size is
// too large to matter is checked in size_plan_check.cpp, where the size inside is known.
#include "scantet/app/idle_options.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/io/mesh_io.h"
#include "scantet/places/place.h"

namespace scantet {
namespace {

[[noreturn]] void refuse(const OptionValue& value, const std::string& why, const std::string& remedy) {
  throw Error(Fault::usage, "usage.no_effect", value.place + ": it does nothing here: " + why, remedy);
}

/// Whether the mesh is kept, or one of its files holds it. Without files the job only looks at the mesh.
bool can_hold(const MeshJob& job, MeshExtra extra) {
  if (job.is_kept || job.outputs.empty()) return true;
  return std::any_of(job.outputs.begin(), job.outputs.end(), [&](const std::string& output) {
    const MeshFormat* const format = mesh_format_of(output);
    return format != nullptr && format->can_hold(extra);
  });
}

/// Of fields, reports in JSON tell.
bool fields_do_something(const MeshJob& job) {
  return can_hold(job, MeshExtra::fields) ||
         std::any_of(job.reports.begin(), job.reports.end(),
                     [](const std::string& report) { return file_extension(report) == ".json"; });
}

/// Another set or a material may be of the places of this one.
bool set_does_something(const MeshJob& job, const NamedPlace& set) {
  if (!job.model.materials.empty()) return true;
  for (const std::string& text : job.model.sets) {
    const std::vector<std::string> used = sets_of(read_named_place("--set", text).place);
    if (std::find(used.begin(), used.end(), set.name) != used.end()) return true;
  }
  const auto holds = [&](PlaceItems items, MeshExtra extra) {
    return (set.items == PlaceItems::all || set.items == items) && can_hold(job, extra);
  };
  return holds(PlaceItems::nodes, MeshExtra::node_sets) || holds(PlaceItems::facets, MeshExtra::facet_sets) ||
         holds(PlaceItems::elements, MeshExtra::tet_sets);
}

/// Refuses sets and fields that none of the files holds.
void refuse_unheld(const MeshJob& job) {
  const char* const other_format = "leave it out, or write a format that holds them (docs/formats.md), .vtu say";
  for (const OptionValue& value : job.given) {
    const bool is_field = value.name == "field" || (value.name == "quality-fields" && job.quality_fields);
    if (is_field && value.text != "none" && !fields_do_something(job)) {
      refuse(value, "none of the mesh files that are written holds fields", other_format);
    }
    if (value.name != "set" || value.text == "none") continue;
    if (!set_does_something(job, read_named_place("--set", value.text))) {
      refuse(value, "none of the mesh files that are written holds such sets",
             "leave it out, or write a format that holds them (docs/formats.md), .inp or .msh say");
    }
  }
}

}  // namespace

bool is_given(const MeshJob& job, const std::string& name) {
  return std::any_of(job.given.begin(), job.given.end(),
                     [&](const OptionValue& value) { return value.name == name && value.text != "none"; });
}

void refuse_idle_options(const MeshJob& job, const SizePlan& sizes) {
  struct Rule {
    const char* option;
    bool works;
    const char* why;
    const char* remedy;
  };
  const char* const no_shape = "no size of this job goes by the shape of the boundary";
  const char* const ask_for_shape = "leave it out, or let sizes go by the shape: --size auto, or --boundary-size auto";
  const Rule rules[] = {
      {"least-size", sizes.goes_by_shape() || sizes.has_source(),
       "it bounds what auto, a formula or an image gives, and the sizes of this job are numbers, which hold as they "
       "are",
       "leave it out, or give --size auto, a formula or an image"},
      {"feature-share", sizes.goes_by_shape(), no_shape, ask_for_shape},
      {"lipschitz", sizes.goes_by_shape(), no_shape, ask_for_shape},
      {"certificate", job.certify != Certify::no, "nothing is verified", "leave it out, or add --certify"},
      {"space", job.is_kept || !job.outputs.empty(), "it is of the coordinates in mesh files, and none is written",
       "leave it out, or name a mesh file with --output"},
  };
  for (const OptionValue& value : job.given) {
    for (const Rule& rule : rules) {
      if (value.name == rule.option && value.text != "none" && !rule.works) refuse(value, rule.why, rule.remedy);
    }
  }
  refuse_unheld(job);
}

void set_input_option(OptionSet& of_plugin, const OptionValue& value, const std::string& input) {
  if (of_plugin.find(value.name) == nullptr) {
    refuse(value, "it is an option of other inputs than " + input,
           "leave it out; scantet plugins lists the options of each kind of input");
  }
  of_plugin.set(value);
}

}  // namespace scantet
