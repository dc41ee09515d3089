// A mesh as the end of a pipeline of ITK's:   itk_pipeline MESH
// Needs ITK; the smoothing filter stands for whatever comes before.
#include <itkCommand.h>
#include <itkDiscreteGaussianImageFilter.h>
#include <itkImage.h>
#include <itkImageRegionIteratorWithIndex.h>
#include <scantet/adapters/itk_mesh_filter.h>
#include <scantet/scantet.h>

#include <cmath>
#include <iostream>

namespace {

using Image = itk::Image<float, 3>;
using Mesher = itk::ScantetMeshFilter<Image>;

// A ball of 12 mm with a hole along z, 1 mm apart; its inside is above 0.
Image::Pointer made_image() {
  auto image = Image::New();
  image->SetRegions(Image::RegionType({-16, -16, -16}, {33, 33, 33}));
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<Image> at(image, image->GetBufferedRegion()); !at.IsAtEnd(); ++at) {
    const auto i = at.GetIndex();
    const double from_axis = std::hypot(double(i[0]), double(i[1]));
    at.Set(static_cast<float>(std::min(12 - std::hypot(from_axis, double(i[2])), from_axis - 4)));
  }
  return image;
}

// Told of every step; mesher->AbortGenerateDataOn() here would end the run.
class Teller final : public itk::Command {
 public:
  static Pointer New() {
    Pointer made = new Teller;
    made->UnRegister();
    return made;
  }
  void Execute(itk::Object* caller, const itk::EventObject& event) override {
    Execute(static_cast<const itk::Object*>(caller), event);
  }
  void Execute(const itk::Object* caller, const itk::EventObject&) override {
    const auto* const mesher = dynamic_cast<const Mesher*>(caller);
    if (mesher == nullptr || mesher->GetProgress() < told_ + 0.2F) return;
    told_ = mesher->GetProgress();
    std::cout << static_cast<int>(100 * told_) << " %\n";
  }

 private:
  float told_ = 0;
};

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: itk_pipeline MESH\n";
    return 2;
  }
  try {
    auto smooth = itk::DiscreteGaussianImageFilter<Image, Image>::New();
    smooth->SetInput(made_image());
    smooth->SetVariance(0.5);
    scantet::ScanMeshOptions options;
    options.levels = {0};
    options.sizes.size = "2";
    auto mesher = Mesher::New();
    mesher->SetInput(smooth->GetOutput());
    mesher->SetOptions(options);
    mesher->AddObserver(itk::ProgressEvent(), Teller::New());
    mesher->Update();
    std::cout << mesher->GetOutput()->GetNumberOfCells() << " cells of an itk::Mesh\n";
    std::cout << scantet::text_report(mesher->GetOutcome().report);
    scantet::write_mesh(mesher->GetOutcome().mesh, words[1]);
    return mesher->GetOutcome().findings.empty() ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return static_cast<int>(error.fault());
  } catch (const itk::ExceptionObject& error) {
    std::cerr << error << '\n';
    return 1;
  }
}
