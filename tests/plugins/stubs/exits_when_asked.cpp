// Ends the process when asked for its options.
#include <cstdlib>

#include "stub_plugin.h"

namespace {

class Exits final : public stub::StubPlugin {
 public:
  Exits() : StubPlugin("exits") {}
  void declare_options(scantet::OptionSet&) override { std::_Exit(7); }
};

}  // namespace

SCANTET_PLUGIN(Exits);
