// The steps are those of cli/mesh_command.cpp, info_command.cpp and verify_command.cpp, without a terminal.
#include "job.h"

#include <pybind11/stl.h>

#include <exception>
#include <memory>

#include "arrays.h"
#include "python_domain.h"
#include "scantet/app/built_in_plugins.h"
#include "scantet/app/idle_options.h"
#include "scantet/app/info.h"
#include "scantet/app/job.h"
#include "scantet/app/mesh_command_options.h"
#include "scantet/app/plugin_object.h"
#include "scantet/base/error.h"
#include "scantet/plugin/plugin_loader.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/verification/verify_job.h"
#include "watched_run.h"

namespace scantet::python {
namespace {

namespace py = pybind11;

struct FolderPlugins {
  std::vector<PluginEntry> entries;
  std::vector<std::string> warnings;
};

/// The plugins of the folder beside the library, tried and loaded once in the life of the process. No Python runs here:
/// it might hand its lock to a thread that waits for this.
const FolderPlugins& load_folder_plugins() {
  static const FolderPlugins loaded = [] {
    PluginRegistry registry = built_in_plugins();
    const std::size_t built_in = registry.entries().size();
    FolderPlugins plugins;
    plugins.warnings = load_plugin_folder(plugin_folder(), registry);
    const auto first = registry.entries().begin() + static_cast<std::ptrdiff_t>(built_in);
    plugins.entries.assign(first, registry.entries().end());
    return plugins;
  }();
  return loaded;
}

/// They, and a warning for each that is passed over, once. Called with Python's lock.
const std::vector<PluginEntry>& folder_plugins() {
  static bool is_told = false;
  const FolderPlugins& plugins = load_folder_plugins();
  if (!std::exchange(is_told, true)) {
    for (const std::string& warning : plugins.warnings) {
      if (PyErr_WarnEx(PyExc_UserWarning, ("passed over " + warning).c_str(), 1) != 0) throw py::error_already_set();
    }
  }
  return plugins.entries;
}

bool has_file(const PluginRegistry& registry, const std::string& file) {
  for (const PluginEntry& entry : registry.entries()) {
    if (entry.file == file) return true;
  }
  return false;
}

/// As the command's: what is built in, what is named, what is in the folder.
PluginRegistry registry_for(const Call& call, const std::shared_ptr<PythonFailure>& failure) {
  PluginRegistry registry = built_in_plugins(std::make_shared<const ScansInMemory>(call.scans));
  for (const std::string& file : call.plugins) load_plugin(file, registry);
  for (const PluginEntry& entry : folder_plugins()) {
    if (!has_file(registry, entry.file)) registry.add(entry.create, entry.file);
  }
  if (call.domain && !call.domain.is_none()) registry.add(python_domain_plugin(call.domain, failure));
  return registry;
}

const char* name_of(OptionKind kind) {
  switch (kind) {
    case OptionKind::flag:
      return "flag";
    case OptionKind::number:
      return "number";
    case OptionKind::integer:
      return "integer";
    case OptionKind::choice:
      return "choice";
    case OptionKind::text:
      return "text";
    case OptionKind::list:
      return "list";
    case OptionKind::numbers:
      return "numbers";
  }
  return "text";
}

py::list described(const std::vector<const OptionSet*>& sets) {
  py::list all;
  for (const OptionSet* set : sets) {
    for (const Option& option : set->options()) {
      py::dict one;
      one["name"] = text(option.name);
      one["kind"] = name_of(option.kind);
      one["group"] = text(option.text.group);
      one["metavar"] = text(option.text.metavar);
      one["help"] = text(option.text.help);
      one["limits"] = text(option.limits);
      one["default"] = py::cast(option.default_values);
      one["unset"] = text(option.text.unset);
      all.append(one);
    }
  }
  return all;
}

/// Runs the work; what the Python code of a domain raised goes before what came of it.
void run_checked(const Call& call, const PythonFailure& failure, const std::function<void(Progress&)>& work) {
  try {
    run_watched(call.progress, work);
  } catch (const Error&) {
    failure.rethrow();
    throw;
  }
}

}  // namespace

py::list mesh_options(const std::vector<std::string>& plugins) {
  Call call;
  call.plugins = plugins;
  const PluginRegistry registry = registry_for(call, nullptr);
  return described(MeshCommandOptions(registry).sets());
}

py::list verify_options() {
  VerifyJob job;
  OptionSet set;
  job.declare_options(set);
  return described({&set});
}

JobResult run_mesh(const Call& call) {
  const auto failure = std::make_shared<PythonFailure>();
  const PluginRegistry registry = registry_for(call, failure);
  MeshCommandOptions options(registry);
  options.take(call.values);
  options.job().input = call.input;
  options.job().is_kept = true;
  JobResult result;
  run_checked(call, *failure, [&](Progress& progress) { result = run_mesh_job(options.job(), registry, progress); });
  return result;
}

std::string run_info(const Call& call) {
  const auto failure = std::make_shared<PythonFailure>();
  const PluginRegistry registry = registry_for(call, failure);
  const auto plugin = registry.create_for(call.input);
  OptionSet options;
  plugin->declare_options(options);
  for (const OptionValue& value : call.values) set_input_option(options, value, call.input);
  std::vector<InfoSection> sections;
  run_checked(call, *failure, [&](Progress& progress) { sections = plugin->info(call.input, progress); });
  return info_json(sections);
}

py::tuple run_verification(const std::string& mesh, const std::vector<OptionValue>& values,
                           const py::object& progress) {
  VerifyJob job;
  OptionSet set;
  job.declare_options(set);
  for (const OptionValue& value : values) set.set(value);
  if (!mesh.empty()) job.mesh = mesh;
  if (!job.certificate.empty()) job = recorded_job(job, values);
  PluginRegistry plugins;
  if (!job.against.empty() && can_read_scan(job.against) == 0) {
    plugins = registry_for({}, nullptr);
    job.read = plugins.files();
    job.read_object = [&plugins](const VerifyJob& of, Progress& watched) {
      return plugin_object(plugins, of, watched);
    };
  }
  VerifyOutcome outcome;
  run_watched(progress, [&](Progress& watched) { outcome = run_verify(job, watched); });
  return py::make_tuple(std::string(scantet::name_of(outcome.certificate.grade())), outcome.is_as_required,
                        text(outcome.text));
}

}  // namespace scantet::python
