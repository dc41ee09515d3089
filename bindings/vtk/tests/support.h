// An image to mesh, a mesher for it, and what it says while it does.
#pragma once

#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "vtkScantetMesher.h"

inline constexpr int kSide = 21;
inline constexpr double kRadius = 8;  // voxels

/// Heights over a ball, on turned axes of different steps; the extent does not begin at 0.
inline vtkSmartPointer<vtkImageData> make_ball() {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(3, 2 + kSide, -4, kSide - 5, 0, kSide - 1);
  image->SetOrigin(-7, 80, 9);
  image->SetSpacing(1, 1.25, 0.75);
  const double c = std::sqrt(0.75);
  image->SetDirectionMatrix(c, -0.5, 0, 0.5, c, 0, 0, 0, -1);
  vtkNew<vtkFloatArray> heights;
  heights->SetName("height");
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        heights->InsertNextValue(static_cast<float>(kRadius - std::hypot(i - 10, j - 10, k - 10)));
      }
    }
  }
  image->GetPointData()->SetScalars(heights);
  return image;
}

/// Calls a function at an event.
class Observer {
 public:
  Observer(vtkObject& object, unsigned long event, std::function<void(void*)> call) : call_(std::move(call)) {
    command_->SetClientData(this);
    command_->SetCallback(
        [](vtkObject*, unsigned long, void* self, void* data) { static_cast<Observer*>(self)->call_(data); });
    object.AddObserver(event, command_);
  }

 private:
  std::function<void(void*)> call_;
  vtkNew<vtkCallbackCommand> command_;
};

/// The errors of a filter, with VTK's own complaints that follow them.
class Errors {
 public:
  explicit Errors(vtkObject& filter) : of_filter_(filter, vtkCommand::ErrorEvent, [this](void* data) { add(data); }) {}
  void watch(vtkAlgorithm& filter) {
    of_pipeline_ = std::make_unique<Observer>(*filter.GetExecutive(), vtkCommand::ErrorEvent, [](void*) {});
  }
  const std::string& text() const { return text_; }

 private:
  void add(void* data) { text_ += static_cast<const char*>(data); }
  std::string text_;
  Observer of_filter_;
  std::unique_ptr<Observer> of_pipeline_;
};

inline vtkSmartPointer<vtkScantetMesher> make_mesher(vtkImageData* image, double level, double size) {
  auto mesher = vtkSmartPointer<vtkScantetMesher>::New();
  mesher->SetInputData(image);
  mesher->SetLevel(level);
  mesher->SetSize(size);
  return mesher;
}
