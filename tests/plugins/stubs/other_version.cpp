// Made for another interface: calling any of it would be a crash.
#include <cstdlib>

#include "stub_plugin.h"

extern "C" {
__attribute__((visibility("default"))) extern const scantet::PluginDescriptor scantet_plugin;
const scantet::PluginDescriptor scantet_plugin{scantet::kInputPluginVersion + 1, "99.0.0",
                                               []() -> scantet::InputPlugin* { std::abort(); }};
}
