// Crashes when it opens something, which no trial finds.
#include <csignal>

#include "stub_plugin.h"

namespace {

class CrashesWhenOpened final : public stub::StubPlugin {
 public:
  CrashesWhenOpened() : StubPlugin("opened") {}
  scantet::OpenedDomain open(const std::string&, scantet::Progress&) override {
    std::raise(SIGSEGV);
    return {};
  }
};

}  // namespace

SCANTET_PLUGIN(CrashesWhenOpened);
