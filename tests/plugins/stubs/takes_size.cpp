// Declares an option that scantet mesh has.
#include "stub_plugin.h"

namespace {

class TakesSize final : public stub::StubPlugin {
 public:
  TakesSize() : StubPlugin("takes_size") {}
  void declare_options(scantet::OptionSet& options) override {
    options.add("size", size_, scantet::Range::above(0), {"Stub", "MM", "a size", "Never set."});
  }

 private:
  double size_ = 1;
};

}  // namespace

SCANTET_PLUGIN(TakesSize);
