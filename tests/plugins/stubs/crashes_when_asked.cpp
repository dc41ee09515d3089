// Crashes when asked what it can open.
#include <csignal>

#include "stub_plugin.h"

namespace {

class CrashesWhenAsked final : public stub::StubPlugin {
 public:
  CrashesWhenAsked() : StubPlugin("asked") {}
  int can_open(const std::string&) const override {
    std::raise(SIGILL);
    return 0;
  }
};

}  // namespace

SCANTET_PLUGIN(CrashesWhenAsked);
