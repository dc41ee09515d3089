// The openers that are there, and the choice among them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/plugin/input_plugin.h"

namespace SCANTET_API scantet {

/// Makes a new object at each call; never null.
using InputPluginFactory = std::function<std::unique_ptr<InputPlugin>()>;

/// A way to make plugin objects of one kind.
struct PluginEntry {
  InputPluginFactory create;
  std::string file;  ///< the shared library it is from; empty: built in
};

/// A list of factories: every job makes its own plugin objects.
class PluginRegistry {
 public:
  /// taken: names of options, without dashes, that a plugin from a shared library may not declare, as they would be set
  /// in place of its own. load_plugin() looks at them; add() does not.
  explicit PluginRegistry(std::vector<std::string> taken = {}) : taken_options_(std::move(taken)) {}

  /// Adds a plugin behind the others. file: the shared library it is from; empty for one that is built in.
  /// Throws Error: usage.plugin (a second plugin of that name), and leaves the list as it was.
  void add(InputPluginFactory create, std::string file = {});

  /// In order of registration.
  const std::vector<PluginEntry>& entries() const { return entries_; }

  /// One fresh object of each plugin, in order of registration.
  std::vector<std::unique_ptr<InputPlugin>> create_all() const;

  /// A fresh object of the plugin with the highest can_open score for the input; the first on a tie. Never null.
  /// Throws Error: input.not_a_file (a pipe, a device or a socket); if no score is above 0: input.not_found,
  /// input.empty (a file of 0 bytes), input.format (nothing opens it).
  std::unique_ptr<InputPlugin> create_for(const std::string& input) const;

  /// A fresh object of the plugin with the highest can_convert score; the first on a tie; null if no score is above 0.
  /// Throws Error: input.not_a_file (the input is a pipe, a device or a socket).
  std::unique_ptr<InputPlugin> create_converter(const std::string& input, const std::string& output) const;

  /// The shared libraries that plugins are from, in order of registration: no output may replace them.
  std::vector<std::string> files() const;

  /// Names of options that no plugin from a shared library may declare.
  const std::vector<std::string>& taken_options() const { return taken_options_; }

 private:
  std::vector<std::string> taken_options_;
  std::vector<PluginEntry> entries_;
};

}  // namespace scantet
