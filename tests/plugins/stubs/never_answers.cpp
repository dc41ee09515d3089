// Sleeps when asked for its name.
#include <unistd.h>

#include "stub_plugin.h"

namespace {

class NeverAnswers final : public stub::StubPlugin {
 public:
  NeverAnswers() : StubPlugin("sleeps") {}
  std::string name() const override {
    while (true) pause();
  }
};

}  // namespace

SCANTET_PLUGIN(NeverAnswers);
