// Has the name of a plugin that is built in.
#include "stub_plugin.h"

namespace {

class SecondImage final : public stub::StubPlugin {
 public:
  SecondImage() : StubPlugin("image") {}
};

}  // namespace

SCANTET_PLUGIN(SecondImage);
