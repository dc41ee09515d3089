// The order of the elements is the one that both published schemas take: ModuleDescription.xsd of the Slicer execution
// model, and that of CTK's command line modules.
#include "scantet/cli/slicer_module.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ostream>

#include "scantet/app/job.h"
#include "scantet/base/error.h"
#include "scantet/base/version.h"
#include "scantet/base/xml_text.h"
#include "scantet/cli/command.h"
#include "scantet/cli/help.h"
#include "scantet/cli/print.h"
#include "scantet/cli/results.h"
#include "scantet/cli/slicer_progress.h"
#include "scantet/io/atomic_file.h"

namespace scantet {
namespace {

constexpr const char* kName = "ScantetMesh";

// Of the job, but not of a module: files are Slicer's business, and models are handed over in LPS.
constexpr std::array kLeftOut{"output", "space", "plan"};

std::string element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + xml_escaped(text) + "</" + tag + ">";
}

std::string with_underscores(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// What the module can be given: the options of images and those of the job.
struct ModuleOptions {
  explicit ModuleOptions(const PluginRegistry& plugins) {
    for (auto& plugin : plugins.create_all()) {
      if (plugin->name() == "image") images = std::move(plugin);
    }
    if (!images) throw Error(Fault::internal, "internal.plugin", "there is no plugin for images");
    images->declare_options(of_image);
    job.declare_options(of_job);
  }
  static bool is_left_out(const std::string& name) {
    return std::find(kLeftOut.begin(), kLeftOut.end(), name) != kLeftOut.end();
  }
  const Option* find(const std::string& name) const {
    if (is_left_out(name)) return nullptr;
    const Option* const option = of_image.find(name);
    return option != nullptr ? option : of_job.find(name);
  }

  std::unique_ptr<InputPlugin> images;
  MeshJob job;
  OptionSet of_image;
  OptionSet of_job;
};

std::optional<double> number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size()) return std::nullopt;
  return value;
}

// "from 0 to 60" -> both numbers.
std::optional<std::array<double, 2>> bounds_in(const std::string& limits) {
  const std::size_t middle = limits.find(" to ");
  if (!limits.starts_with("from ") || middle == std::string::npos) return std::nullopt;
  const auto low = number_in(limits.substr(5, middle - 5));
  const auto high = number_in(limits.substr(middle + 4));
  if (!low || !high) return std::nullopt;
  return std::array{*low, *high};
}

// A number without a default, or one that can be a word as well, is typed as text.
std::string type_of(const Option& option) {
  const bool is_plain = !option.default_values.empty() && number_in(option.default_values.front()) &&
                        option.limits.find(',') == std::string::npos;
  switch (option.kind) {
    case OptionKind::flag:
      return "boolean";
    case OptionKind::choice:
      return "string-enumeration";
    case OptionKind::integer:
      return "integer";
    case OptionKind::numbers:
      return "double-vector";
    case OptionKind::number:
      return is_plain ? "double" : "string";
    default:
      return "string";
  }
}

std::string default_of(const Option& option) {
  return option.default_values.empty() ? "" : option.default_values.front();
}

std::string choices_of(const Option& option) {
  std::string elements;
  for (const std::string& word : choice_words(option)) elements += "      " + element("element", word) + "\n";
  return elements;
}

std::string describe(const Option& option) {
  constexpr double kSteps = 100;
  const std::string type = type_of(option);
  const std::string facts = option_facts(option);
  std::string label = option.name;
  std::replace(label.begin(), label.end(), '-', ' ');
  if (!option.text.metavar.empty()) label += " (" + option.text.metavar + ")";
  std::string text = "    <" + type + ">\n      " + element("name", with_underscores(option.name)) + "\n      " +
                     element("longflag", with_underscores(option.name)) + "\n      " +
                     element("description", option.text.help + (facts.empty() ? "" : " [" + facts + "]")) + "\n      " +
                     element("label", label) + "\n      " + element("default", default_of(option)) + "\n";
  if (option.kind == OptionKind::choice) text += choices_of(option);
  const auto bounds = type == "double" || type == "integer" ? bounds_in(option.limits) : std::nullopt;
  if (bounds) {
    text += "      <constraints>" + element("minimum", number_text((*bounds)[0])) +
            element("maximum", number_text((*bounds)[1])) +
            element("step", number_text(type == "integer" ? 1 : ((*bounds)[1] - (*bounds)[0]) / kSteps)) +
            "</constraints>\n";
  }
  return text + "    </" + type + ">\n";
}

std::string describe_group(const std::string& title, const std::vector<const Option*>& options) {
  std::string text = "  <parameters>\n    " + element("label", title) + "\n    " + element("description", title) + "\n";
  for (const Option* option : options) text += describe(*option);
  return text + "  </parameters>\n";
}

constexpr const char* kFiles = R"xml(  <parameters>
    <label>Input and output</label>
    <description>What is meshed, and the mesh</description>
    <image type="scalar">
      <name>input</name>
      <index>0</index>
      <description>A scan, or a label map (a segmentation exported to one), whose labels become regions</description>
      <label>Scan or label map</label>
      <channel>input</channel>
    </image>
    <geometry type="model" fileExtensions=".vtk,.vtu">
      <name>mesh</name>
      <index>1</index>
      <description>The tetrahedral mesh, as a model</description>
      <label>Tetrahedral mesh</label>
      <channel>output</channel>
    </geometry>
  </parameters>
)xml";

struct Result {
  const char* name;
  const char* type;
  const char* label;
};

// What goes into --returnparameterfile.
constexpr Result kResults[] = {{"vertices", "integer", "vertices"},
                               {"tets", "integer", "tetrahedra"},
                               {"volume_mm3", "double", "volume (mm^3)"},
                               {"min_dihedral_deg", "double", "smallest dihedral angle (degrees)"},
                               {"max_dihedral_deg", "double", "largest dihedral angle (degrees)"},
                               {"unmet", "integer", "bounds missed, and faults found"}};

std::string describe_results() {
  std::string text = "  <parameters>\n    <label>Results</label>\n    <description>Of the last run</description>\n";
  for (const Result& result : kResults) {
    const std::string type = result.type;
    text += "    <" + type + ">\n      " + element("name", result.name) + "\n      " + element("index", "1000") +
            "\n      " + element("description", result.label) + "\n      " + element("label", result.label) +
            "\n      " + element("default", "0") + "\n      " + element("channel", "output") + "\n    </" + type +
            ">\n";
  }
  return text + "  </parameters>\n";
}

void write_results(const std::string& file, const JobResult& result) {
  if (file.empty() || !result.report.mesh || !result.report.quality) return;
  const ReportMesh& mesh = *result.report.mesh;
  write_file(file, [&](std::ostream& out) {
    out << "vertices = " << mesh.vertices << "\ntets = " << mesh.tets
        << "\nvolume_mm3 = " << number_text(mesh.volume_mm3)
        << "\nmin_dihedral_deg = " << number_text(result.report.quality->min_dihedral_deg())
        << "\nmax_dihedral_deg = " << number_text(result.report.quality->max_dihedral_deg())
        << "\nunmet = " << result.findings.size() << "\n";
  });
}

bool is_default(const Option& option, const std::string& text) {
  if (text.empty()) return true;
  if (option.kind == OptionKind::flag) return text == "false";
  if (option.default_values.size() != 1) return false;
  const auto a = number_in(text);
  const auto b = number_in(option.default_values.front());
  return text == option.default_values.front() || (a && b && *a == *b);
}

// What the caller asks beside the options.
struct ModuleCall {
  std::string returns;  // file for results
  std::string address;  // of a structure of Slicer's, which only modules in its own process can use
  bool xml = false;
  bool echo = false;
};

void take(const std::vector<OptionValue>& typed, OptionSet& of_call, ModuleOptions& options) {
  std::vector<OptionValue> values;
  for (const OptionValue& value : typed) {
    if (of_call.find(value.name) != nullptr) {
      of_call.set(value);
      continue;
    }
    const Option& option = *options.find(value.name);
    if (is_default(option, value.text)) continue;
    if (option.kind != OptionKind::numbers) {
      values.push_back(value);
      continue;
    }
    for (std::size_t begin = 0; begin < value.text.size();) {  // a vector: commas between
      const std::size_t end = std::min(value.text.find(',', begin), value.text.size());
      values.push_back({value.name, value.text.substr(begin, end - begin), value.place});
      begin = end + 1;
    }
  }
  distribute_options(values, options.of_job, {&options.of_image}, options.job);
}

// Flags as Slicer has them: --min_dihedral.
std::vector<std::string> with_hyphens(std::vector<std::string> words) {
  for (std::string& word : words) {
    if (!word.starts_with("--")) continue;
    const auto name_end = word.begin() + static_cast<std::ptrdiff_t>(std::min(word.find('='), word.size()));
    std::replace(word.begin(), name_end, '_', '-');
  }
  return words;
}

}  // namespace

std::string slicer_description(const PluginRegistry& plugins) {
  const ModuleOptions options(plugins);
  std::string text = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n  " +
                     element("category", "Surface Models.Advanced") + "\n  " +
                     element("title", "Tetrahedral mesh (scantet)") + "\n  " + element("description", kProgramPurpose) +
                     "\n  " + element("version", kVersion) + "\n  " + element("documentation-url", "") + "\n  " +
                     element("license", "GPL-3.0-or-later") + "\n  " +
                     element("contributor", "The scantet developers") + "\n" + kFiles;
  std::vector<std::pair<std::string, std::vector<const Option*>>> groups;
  for (const OptionSet* set : {&options.of_image, &options.of_job}) {
    for (const Option& option : set->options()) {
      if (ModuleOptions::is_left_out(option.name)) continue;
      auto group =
          std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == option.text.group; });
      if (group == groups.end()) group = groups.insert(groups.end(), {option.text.group, {}});
      group->second.push_back(&option);
    }
  }
  for (const auto& [title, members] : groups) text += describe_group(title, members);
  return text + describe_results() + "</executable>\n";
}

int run_slicer_module(const std::vector<std::string>& words, const PluginRegistry& plugins) {
  ModuleOptions options(plugins);
  ModuleCall call;
  OptionSet of_call;
  of_call.add("returnparameterfile", call.returns, {"Module", "FILE", "a file name", "Where results go."});
  of_call.add("processinformationaddress", call.address, {"Module", "ADDRESS", "an address", "Not used."});
  of_call.add("xml", call.xml, {"Module", "", "a flag", "Describe the parameters."});
  of_call.add("echo", call.echo, {"Module", "", "a flag", "Print the command line."});
  const CommandLine line = parse_command_line(with_hyphens(words), {&of_call, &options.of_image, &options.of_job});
  for (const OptionValue& value : line.values) {
    if (ModuleOptions::is_left_out(value.name)) {
      throw Error(Fault::usage, "usage.unknown_option", value.place + ": not a parameter of the module",
                  "--xml describes them");
    }
  }
  take(line.values, of_call, options);
  if (call.xml || line.help) {
    print(slicer_description(plugins));
    return kExitDone;
  }
  const bool has_more = line.arguments.size() > 2;
  const std::vector<std::string> files = has_more ? line.arguments : take_arguments(line, {"INPUT", "OUTPUT"});
  if (call.echo) {
    std::string text = kName;
    for (const std::string& word : words) text += " " + word;
    print(text + "\n");
  }
  options.job.input = files[0];
  options.job.outputs.assign(files.begin() + 1, files.end());
  if (!call.returns.empty()) options.job.beside = {call.returns};
  JobResult result;
  {
    SlicerProgress progress(kName);
    result = run_mesh_job(options.job, plugins, progress);
  }
  if (result.cancelled) return print_cancelled();
  write_results(call.returns, result);
  const int status = print_result(result, false);
  return status == kExitUnmet && !result.written.empty() ? kExitDone : status;
}

}  // namespace scantet
