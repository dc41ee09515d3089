// Breaks, for "liar:HOW", the promise that HOW names.
#include <stdexcept>

#include "stub_plugin.h"

namespace {

/// A ball of radius 1 that gives another box.
class WrongBox final : public scantet::Domain {
 public:
  explicit WrongBox(const scantet::Box& box) : box_(box) {}
  scantet::Box bounds() const override { return box_; }
  scantet::Region region_at(const scantet::Point& p) const override { return ball_->region_at(p); }
  void crossings(const scantet::Segment& segment, scantet::Crossings& out) const override {
    ball_->crossings(segment, out);
  }

 private:
  std::unique_ptr<scantet::Domain> ball_ = scantet::make_sphere({}, 1);
  scantet::Box box_;
};

/// A ball that throws when it is asked.
class Thrower final : public scantet::Domain {
 public:
  scantet::Box bounds() const override { return {{-2, -2, -2}, {2, 2, 2}}; }
  scantet::Region region_at(const scantet::Point&) const override { throw std::out_of_range("index 8"); }
  void crossings(const scantet::Segment&, scantet::Crossings&) const override { throw std::out_of_range("index 9"); }
};

class Liar final : public stub::StubPlugin {
 public:
  Liar() : StubPlugin("liar") {}
  scantet::OpenedDomain open(const std::string& input, scantet::Progress& progress) override {
    const std::string how = input.substr(input.find(':') + 1);
    scantet::OpenedDomain opened = StubPlugin::open(input, progress);
    const auto give = [&](const scantet::Box& box) { opened.domain = std::make_unique<WrongBox>(box); };
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (how == "cuts") give({{-2, -2, -2}, {2, 2, 0.5}});
    if (how == "grazes") give({{-2, -2, -2}, {2, 2, 0.9999}});
    if (how == "within") give({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}});
    if (how == "infinite") give({{-2, -2, -2}, {2, 2, kInfinite}});
    if (how == "empty") give({});
    if (how == "nothing") opened.domain.reset();
    if (how == "size") opened.default_size_mm = 0;
    if (how == "throws_later") opened.domain = std::make_unique<Thrower>();
    if (how == "throws") throw std::out_of_range("index 7");
    return opened;
  }
};

}  // namespace

SCANTET_PLUGIN(Liar);
