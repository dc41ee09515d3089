// Throws when an object is made.
#include <stdexcept>

#include "stub_plugin.h"

namespace {

class Throws final : public stub::StubPlugin {
 public:
  Throws() : StubPlugin("throws") { throw std::runtime_error("no licence found"); }
};

}  // namespace

SCANTET_PLUGIN(Throws);
