// Crashes while the library is loaded.
#include <csignal>

#include "stub_plugin.h"

namespace {

class Good final : public stub::StubPlugin {
 public:
  Good() : StubPlugin("crashes") {}
};

const int kCrash = std::raise(SIGSEGV);

}  // namespace

SCANTET_PLUGIN(Good);
