// A filter of ITK's that meshes an image: for pipelines of ITK's. Needs ITK's headers (Mesh), and is in no other header
// of scantet's: include it where you have ITK.
#pragma once

#include <itkImageToMeshFilter.h>
#include <itkMesh.h>
#include <itkProcessObject.h>
#include <itkTetrahedronCell.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <utility>

#include "scantet/adapters/from_itk.h"
#include "scantet/app/mesh_scan.h"
#include "scantet/base/progress_share.h"
#include "scantet/base/tet_mesh.h"

// NOLINTBEGIN(readability-identifier-naming,cppcoreguidelines-owning-memory): names and pointers are as ITK's are
namespace itk {

/// Image in, mesh of tetrahedra out: mesh_scan() as a step of a pipeline.
///
/// TImage: itk::Image of three dimensions with pixels that are numbers. TMesh: itk::Mesh in three dimensions; its
/// points are mm, in LPS, as those of the image are; a cell's data is its region, and so should be a whole number.
/// Cells are tetrahedra of four points, also where tets of second order are asked for: the points on their edges are
/// points of the output then, but of no cell; GetOutcome().mesh has all.
/// The input's voxels are not copied. SetOptions() says what is meshed and how, GetOutcome() tells what came of it: the
/// report, notes, bounds that are not kept.
/// Observers are told of progress (ProgressEvent, a share from 0 to 1 that never falls), on the thread that calls
/// Update(). AbortGenerateDataOn(), from an observer or another thread, ends the run within about a second, by
/// itk::ProcessAborted. Update() throws itk::ProcessAborted, and scantet::Error as scan_from_itk() and mesh_scan() do.
template <class TImage, class TMesh = Mesh<int, 3>>
class ScantetMeshFilter : public ImageToMeshFilter<TImage, TMesh> {
 public:
  /// @cond ITK's conventions.
  ITK_DISALLOW_COPY_AND_MOVE(ScantetMeshFilter);
  using Self = ScantetMeshFilter;
  using Superclass = ImageToMeshFilter<TImage, TMesh>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  static Pointer New() {
    Pointer made = new Self;
    made->UnRegister();
    return made;
  }
  LightObject::Pointer CreateAnother() const override { return New().GetPointer(); }
  const char* GetNameOfClass() const override { return "ScantetMeshFilter"; }
  /// @endcond

  /// What is meshed and how, as mesh_scan() takes it, from the next Update() on. Default: that of ScanMeshOptions.
  void SetOptions(scantet::ScanMeshOptions options) {
    options_ = std::move(options);
    this->Modified();
  }
  /// As set; valid as long as the filter.
  const scantet::ScanMeshOptions& GetOptions() const { return options_; }
  /// Of the last run: the mesh as scantet has it, with its boundary, and what is known of it; valid until the next run.
  /// Empty before the first one, and after one that was aborted or ended in a scantet::Error.
  const scantet::MeshOutcome& GetOutcome() const { return outcome_; }

 protected:
  /// @cond ITK's conventions.
  ScantetMeshFilter() = default;
  ~ScantetMeshFilter() override = default;

  /// The whole image is needed, whatever is asked of the mesh.
  void GenerateInputRequestedRegion() override {
    Superclass::GenerateInputRequestedRegion();
    if (auto* const image = const_cast<TImage*>(this->GetInput())) image->SetRequestedRegionToLargestPossibleRegion();
  }

  void GenerateData() override {
    Watch watch(*this);
    outcome_ = {};
    scantet::MeshOutcome outcome = scantet::mesh_scan(scantet::scan_from_itk(this->GetInput()), options_, watch);
    if (outcome.cancelled) {
      ProcessAborted aborted(__FILE__, __LINE__);
      aborted.SetDescription("the meshing was aborted");
      throw aborted;
    }
    outcome_ = std::move(outcome);
    FillOutput();
    this->UpdateProgress(1.0F);
  }
  /// @endcond

 private:
  using CellType = typename TMesh::CellType;
  using CellPointer = typename CellType::CellAutoPointer;

  /// Tells the filter's observers, and asks whether it is to stop.
  class Watch final : public scantet::Progress {
   public:
    explicit Watch(Self& filter) : filter_(filter) {}
    void report(const scantet::ProgressState& state) override {
      share_ = std::max(share_, static_cast<float>(scantet::progress_share(state)));
      filter_.UpdateProgress(share_);
    }
    bool cancelled() const override { return filter_.GetAbortGenerateData(); }

   private:
    Self& filter_;
    float share_ = 0;
  };

  void FillOutput() {
    TMesh& output = *this->GetOutput();
    output.Initialize();
    output.SetCellsAllocationMethod(MeshEnums::MeshClassCellsAllocationMethod::CellsAllocatedDynamicallyCellByCell);
    const scantet::TetMesh& mesh = outcome_.mesh;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      typename TMesh::PointType point;
      for (int axis = 0; axis < 3; ++axis) {
        point[static_cast<unsigned>(axis)] = static_cast<typename TMesh::CoordRepType>(mesh.vertices[v][axis]);
      }
      output.SetPoint(v, point);
    }
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      CellPointer cell;
      cell.TakeOwnership(new TetrahedronCell<CellType>);
      for (int corner = 0; corner < 4; ++corner)
        cell->SetPointId(corner, mesh.tets[t][static_cast<std::size_t>(corner)]);
      output.SetCell(t, cell);
      output.SetCellData(t, static_cast<typename TMesh::CellPixelType>(mesh.tet_regions[t]));
    }
    output.SetBufferedRegion(output.GetRequestedRegion());  // all that was asked for is there
  }

  scantet::ScanMeshOptions options_;
  scantet::MeshOutcome outcome_;
};

}  // namespace itk
// NOLINTEND(readability-identifier-naming,cppcoreguidelines-owning-memory)
