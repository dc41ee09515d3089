// A plugin that opens "NAME:" as a ball of radius 1, for tests to spoil.
#pragma once

#include "scantet/domain/analytic.h"
#include "scantet/plugin/plugin.h"

namespace stub {

class StubPlugin : public scantet::InputPlugin {
 public:
  explicit StubPlugin(std::string name) : name_(std::move(name)) {}
  std::string name() const override { return name_; }
  std::string description() const override { return name_ + ":, a ball"; }
  int can_open(const std::string& input) const override { return input.starts_with(name_ + ":") ? 100 : 0; }
  void declare_options(scantet::OptionSet&) override {}
  scantet::OpenedDomain open(const std::string&, scantet::Progress&) override {
    return {scantet::make_sphere({}, 1), std::nullopt, 0.3, "it is a test", {}};
  }
  std::vector<scantet::InfoSection> info(const std::string&, scantet::Progress&) override { return {}; }

 private:
  std::string name_;
};

}  // namespace stub
