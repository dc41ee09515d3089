// A plugin without files: opens names with a given ending as a ball, and turns them into .txt files.
#pragma once

#include <fstream>
#include <stdexcept>

#include "scantet/domain/analytic.h"
#include "scantet/plugin/plugin_registry.h"

namespace scantet {

class FakePlugin final : public InputPlugin {
 public:
  FakePlugin(std::string name, std::string suffix, int score)
      : name_(std::move(name)), suffix_(std::move(suffix)), score_(score) {}
  std::string name() const override { return name_; }
  std::string description() const override { return "things ending in " + suffix_; }
  int can_open(const std::string& input) const override { return input.ends_with(suffix_) ? score_ : 0; }
  void declare_options(OptionSet& options) override {
    options.add("radius", radius_, Range::above(0), {"Fake", "MM", "a radius", "Radius of the ball."});
  }
  OpenedDomain open(const std::string&, Progress&) override {
    return {make_sphere({0, 0, 0}, radius_), std::nullopt, radius_ / 2, "half the radius", {}};
  }
  std::vector<InfoSection> info(const std::string&, Progress&) override { return {}; }
  int can_convert(const std::string& input, const std::string& output) const override {
    return input.ends_with(suffix_) && output.ends_with(".txt") ? score_ : 0;
  }
  bool convert(const std::string& input, const std::string& output, Progress& progress) override {
    if (input.starts_with("fails")) throw std::runtime_error("no ink");
    if (progress.cancelled() || input.starts_with("gives_up")) return false;
    if (!input.starts_with("forgets")) std::ofstream(output) << input;
    return true;
  }

 private:
  std::string name_;
  std::string suffix_;
  int score_;
  double radius_ = 10;
};

inline InputPluginFactory fake_plugin(const std::string& name, const std::string& suffix, int score) {
  return [=] { return std::make_unique<FakePlugin>(name, suffix, score); };
}

}  // namespace scantet
