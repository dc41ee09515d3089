// Throws while the library is loaded, before anything of it can be called.
#include <stdexcept>

#include "stub_plugin.h"

namespace {

class Good final : public stub::StubPlugin {
 public:
  Good() : StubPlugin("throws_on_load") {}
};

struct Static {
  Static() { throw std::runtime_error("a static object failed"); }
} g_static;

}  // namespace

SCANTET_PLUGIN(Good);
