// What a shared library exports to be a plugin of scantet; docs/plugins.md shows a whole one.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/version.h"
#include "scantet/plugin/input_plugin.h"

namespace SCANTET_API scantet {

/// The one symbol of a plugin library, under the name kPluginSymbol. It is data, so that its version can be looked at
/// before any code of the library is called (the constructors of its static objects apart).
struct PluginDescriptor {
  int interface_version;        ///< kInputPluginVersion as the plugin was compiled with; first in every version
  const char* scantet_version;  ///< kVersion as the plugin was compiled with, for messages
  InputPlugin* (*create)();     ///< a new object, owned by the caller
};

/// The name of that symbol.
inline constexpr const char* kPluginSymbol = "scantet_plugin";

}  // namespace scantet

/// Makes a shared library a plugin: defines its PluginDescriptor. Type: a default-constructible class derived from
/// InputPlugin. Once in a library, outside any namespace, with a semicolon.
// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define SCANTET_PLUGIN(Type)                                                                              \
  extern "C" {                                                                                            \
  __attribute__((visibility("default"))) extern const ::scantet::PluginDescriptor scantet_plugin;         \
  const ::scantet::PluginDescriptor scantet_plugin{::scantet::kInputPluginVersion, ::scantet::kVersion,   \
                                                   []() -> ::scantet::InputPlugin* { return new Type; }}; \
  }                                                                                                       \
  static_assert(true, "takes the semicolon")
// NOLINTEND(bugprone-macro-parentheses)
