#include "contract/domain_contract.h"
#include "scantet/cuts/cut_domain.h"
#include "scantet/cuts/cut_text.h"
#include "scantet/labels/label_domain.h"
#include "scantet/labels/label_object.h"
#include "unit/frames.h"
#include "unit/labels/label_scan.h"

namespace scantet {
namespace {

using test::plain;

std::unique_ptr<Domain> domain_of(const Scan& scan, LabelSmoothing smoothing) {
  LabelSettings settings;
  settings.smoothing = smoothing;
  return make_label_domain(make_label_field(scan, settings));
}

DomainCase noise_case(const char* name, Frame (*frame)(), int labels, LabelSmoothing smoothing = LabelSmoothing::none) {
  return {name, [=]() { return domain_of(test::label_noise({17, 13, 11}, labels, frame()), smoothing); }};
}

DomainCase cells_case(const char* name, Frame (*frame)(), int labels, LabelSmoothing smoothing = LabelSmoothing::none) {
  return {name, [=]() { return domain_of(test::label_cells({37, 43, 51}, labels, frame()), smoothing); }};
}

/// Cut in planes between cells, where curves that are found cell by cell may jump.
DomainCase cut_case(const char* name, const std::vector<std::string>& cuts) {
  return {name, [=]() {
            LabelSettings settings;
            settings.smoothing = LabelSmoothing::keep;
            Progress progress;
            LabelObject object = make_label_object(test::label_noise({9, 8, 7}, 9), settings, progress);
            std::vector<CutPlane> planes;
            for (const std::string& text : cuts) read_cut("--cut", text, planes);
            return make_cut_domain(std::move(object.domain), planes, 0.5, 1);
          }};
}

INSTANTIATE_TEST_SUITE_P(Labels, DomainContract,
                         ::testing::Values(noise_case("OneNoisy", plain, 1),
                                           noise_case("ThreeNoisyOblique", test::oblique, 3),
                                           noise_case("ManyNoisySheared", test::flipped_and_sheared, 60),
                                           cells_case("FourCells", plain, 4),
                                           cells_case("TwentyCellsOblique", test::oblique, 20),
                                           cells_case("ManyCellsSheared", test::flipped_and_sheared, 300),
                                           noise_case("SmoothedNoise", plain, 9, LabelSmoothing::keep),
                                           cells_case("SmoothedCellsOblique", test::oblique, 20, LabelSmoothing::keep),
                                           cut_case("NoiseCutAtLayers", {"z < 3", "x > 4"})),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace scantet
