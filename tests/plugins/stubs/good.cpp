// Nothing is wrong with it.
#include "stub_plugin.h"

namespace {

class Good final : public stub::StubPlugin {
 public:
  Good() : StubPlugin("good") {}
};

}  // namespace

SCANTET_PLUGIN(Good);
