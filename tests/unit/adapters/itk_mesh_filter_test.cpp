#include "scantet/adapters/itk_mesh_filter.h"

#include <gtest/gtest.h>
#include <itkCommand.h>
#include <itkImage.h>
#include <itkImageRegionIteratorWithIndex.h>

#include <cmath>

#include "scantet/base/error.h"

namespace scantet {
namespace {

using FloatImage = itk::Image<float, 3>;
using Filter = itk::ScantetMeshFilter<FloatImage>;

constexpr double kRadiusMm = 8;

/// Radius less distance from (100, 0, 0), 1 mm apart, around it.
FloatImage::Pointer make_ball() {
  auto image = FloatImage::New();
  const FloatImage::RegionType region({-10, -10, -10}, {21, 21, 21});
  image->SetRegions(region);
  image->Allocate();
  const double origin[] = {100, 0, 0};
  image->SetOrigin(origin);
  for (itk::ImageRegionIteratorWithIndex<FloatImage> at(image, region); !at.IsAtEnd(); ++at) {
    const auto i = at.GetIndex();
    at.Set(static_cast<float>(kRadiusMm - std::sqrt(double(i[0] * i[0] + i[1] * i[1] + i[2] * i[2]))));
  }
  return image;
}

Filter::Pointer make_filter(const char* size) {
  auto filter = Filter::New();
  ScanMeshOptions options;
  options.levels = {0};
  options.sizes.size = size;
  filter->SetOptions(options);
  filter->SetInput(make_ball());
  return filter;
}

/// Calls what it is given at every event.
template <class Function>
itk::Command::Pointer call(const Function& function) {
  class Calling final : public itk::Command {
   public:
    explicit Calling(Function f) : f_(std::move(f)) {}
    void Execute(itk::Object*, const itk::EventObject&) override { f_(); }
    void Execute(const itk::Object*, const itk::EventObject&) override { f_(); }

   private:
    Function f_;
  };
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): ITK counts its references
  itk::Command::Pointer command = new Calling(function);
  command->UnRegister();
  return command;
}

TEST(ItkMeshFilter, GivesTheMeshOfMeshScan) {
  const auto filter = make_filter("2");
  filter->Update();
  const auto* const mesh = filter->GetOutput();
  const TetMesh& ours = filter->GetOutcome().mesh;
  Progress progress;
  const MeshOutcome expected = mesh_scan(scan_from_itk(make_ball().GetPointer()), filter->GetOptions(), progress);
  EXPECT_EQ(ours.tets, expected.mesh.tets);
  ASSERT_EQ(mesh->GetNumberOfPoints(), expected.mesh.vertices.size());
  ASSERT_EQ(mesh->GetNumberOfCells(), expected.mesh.tets.size());
  EXPECT_TRUE(filter->GetOutcome().findings.empty());
  for (std::size_t v = 0; v < ours.vertices.size(); ++v) {
    const auto point = mesh->GetPoint(v);
    EXPECT_LE(std::hypot(point[0] - 100, point[1], point[2]), kRadiusMm + 0.3);
  }
  Filter::Superclass::OutputMeshType::CellAutoPointer cell;
  ASSERT_TRUE(mesh->GetCell(7, cell));
  EXPECT_EQ(cell->GetNumberOfPoints(), 4U);
  EXPECT_EQ(cell->PointIdsBegin()[2], ours.tets[7][2]);
  int region = 0;
  ASSERT_TRUE(mesh->GetCellData(7, &region));
  EXPECT_EQ(region, 1);
}

TEST(ItkMeshFilter, RunsOnlyWhenSomethingChanged) {
  const auto filter = make_filter("3");
  int runs = 0;
  filter->AddObserver(itk::StartEvent(), call([&] { ++runs; }));
  filter->Update();
  filter->Update();
  EXPECT_EQ(runs, 1);
  ScanMeshOptions options = filter->GetOptions();
  options.sizes.size = "2.5";
  filter->SetOptions(options);
  filter->Update();
  EXPECT_EQ(runs, 2);
}

TEST(ItkMeshFilter, TellsItsProgress) {
  const auto filter = make_filter("1");
  std::vector<float> shares;
  filter->AddObserver(itk::ProgressEvent(), call([&] { shares.push_back(filter->GetProgress()); }));
  filter->Update();
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0F);
}

TEST(ItkMeshFilter, IsAborted) {
  const auto filter = make_filter("0.3");
  filter->AddObserver(itk::ProgressEvent(), call([&] {
                        if (filter->GetProgress() > 0.05F) filter->AbortGenerateDataOn();
                      }));
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  EXPECT_TRUE(filter->GetOutcome().mesh.tets.empty());
}

TEST(ItkMeshFilter, ThrowsWhatMeshScanThrows) {
  const auto filter = make_filter("2");
  ScanMeshOptions options;
  options.levels = {1000};
  filter->SetOptions(options);
  EXPECT_THROW(filter->Update(), Error);
}

}  // namespace
}  // namespace scantet
