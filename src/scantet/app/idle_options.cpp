// A table of options that work only beside others; all other options always do something. Whether a boundary size is
// too large to matter is checked in size_plan_check.cpp, where the size inside is known.
#include "scantet/app/idle_options.h"

#include <algorithm>

#include "scantet/base/error.h"

namespace scantet {
namespace {

[[noreturn]] void refuse(const OptionValue& value, const std::string& why, const std::string& remedy) {
  throw Error(Fault::usage, "usage.no_effect", value.place + ": it does nothing here: " + why, remedy);
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
}

void set_input_option(OptionSet& of_plugin, const OptionValue& value, const std::string& input) {
  if (of_plugin.find(value.name) == nullptr) {
    refuse(value, "it is an option of other inputs than " + input,
           "leave it out; scantet plugins lists the options of each kind of input");
  }
  of_plugin.set(value);
}

}  // namespace scantet
