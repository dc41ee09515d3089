// Crashes when its static objects are destroyed.
#include <csignal>

#include "stub_plugin.h"

namespace {

struct Bomb {
  ~Bomb() { std::raise(SIGSEGV); }
};
Bomb bomb;

class CrashesAtTheEnd final : public stub::StubPlugin {
 public:
  CrashesAtTheEnd() : StubPlugin("bomb") {}
};

}  // namespace

SCANTET_PLUGIN(CrashesAtTheEnd);
