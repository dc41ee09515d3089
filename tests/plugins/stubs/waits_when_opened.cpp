// Opens the file after its name without a look at what it is: a pipe, in the test, that nobody writes to.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <thread>

#include "scantet/base/error.h"
#include "stub_plugin.h"

namespace {

class WaitsWhenOpened final : public stub::StubPlugin {
 public:
  WaitsWhenOpened() : StubPlugin("waits") {}
  scantet::OpenedDomain open(const std::string& input, scantet::Progress&) override {
    std::thread([] {  // says so when the wait has begun for sure
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      std::fputs("about to wait\n", stderr);
    })
        .detach();
    const std::ifstream file(input.substr(input.find(':') + 1));
    throw scantet::Error(scantet::Fault::input, "input.corrupt", input + ": nothing came");
  }
};

}  // namespace

SCANTET_PLUGIN(WaitsWhenOpened);
