// ITK's filters on an image of floats in index space: only the distances of the voxels count there, so frames that ITK
// has no words for (sheared ones) do not matter. A median changes no value that it keeps, so floats hold those of 16
// bits exactly.
#include "scantet/reading/simplify.h"

#include <itkCurvatureFlowImageFilter.h>
#include <itkDiscreteGaussianImageFilter.h>
#include <itkImportImageFilter.h>
#include <itkMedianImageFilter.h>
#include <itkNearestNeighborExtrapolateImageFunction.h>
#include <itkResampleImageFilter.h>

#include <algorithm>
#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

using FloatImage = itk::Image<float, 3>;

constexpr double kMostVoxels = 4e9;
constexpr double kReach = 4;         // of a Gaussian, in standard deviations
constexpr double kMostSteps = 2000;  // of curvature flow

FloatImage::Pointer to_image(const Scan& scan) {
  auto image = FloatImage::New();
  FloatImage::SizeType size;
  FloatImage::SpacingType spacing;
  for (unsigned axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<itk::SizeValueType>(scan.size[axis]);
    spacing[axis] = scan.frame.spacing_mm(static_cast<int>(axis));
  }
  image->SetRegions(FloatImage::RegionType(size));
  image->SetSpacing(spacing);
  image->Allocate();
  std::visit(
      [&](const auto* voxels) {
        std::transform(voxels, voxels + scan.voxel_count(), image->GetBufferPointer(),
                       [](auto value) { return static_cast<float>(value); });
      },
      scan.voxels);
  return image;
}

template <class Filter>
FloatImage::Pointer output_of(Filter& filter) {
  filter.Update();
  FloatImage::Pointer image = filter.GetOutput();
  image->DisconnectPipeline();
  return image;
}

FloatImage::Pointer median(const FloatImage::Pointer& image, std::uint64_t voxels) {
  const auto size = image->GetLargestPossibleRegion().GetSize();
  const auto most = std::max({size[0], size[1], size[2]});
  if (voxels >= most) {
    throw Error(Fault::usage, "usage.median",
                "--median " + std::to_string(voxels) + ": the image has " + std::to_string(most) +
                    " voxels along its longest axis",
                "1 takes out single voxels of noise, 2 small groups");
  }
  auto filter = itk::MedianImageFilter<FloatImage, FloatImage>::New();
  FloatImage::SizeType radius;
  radius.Fill(voxels);
  filter->SetRadius(radius);
  filter->SetInput(image);
  return output_of(*filter);
}

FloatImage::Pointer gaussian(const FloatImage::Pointer& image, double sigma_mm, double finest_mm) {
  auto filter = itk::DiscreteGaussianImageFilter<FloatImage, FloatImage>::New();
  filter->SetInput(image);
  filter->SetUseImageSpacing(true);
  filter->SetVariance(sigma_mm * sigma_mm);
  filter->SetMaximumError(std::erfc(kReach / std::sqrt(2)));
  filter->SetMaximumKernelWidth(static_cast<unsigned>(2 * std::ceil(kReach * sigma_mm / finest_mm) + 1));
  return output_of(*filter);
}

/// A Gaussian is what heat does in sigma² / 2; curvature flow is heat that keeps to the surfaces of equal value.
FloatImage::Pointer curvature_flow(const FloatImage::Pointer& image, double sigma_mm, double finest_mm) {
  constexpr double kStep = 0.0625;  // of the finest voxel's square: as ITK advises for three dimensions
  const double time = sigma_mm * sigma_mm / 2;
  const double steps = std::ceil(time / (kStep * finest_mm * finest_mm));
  if (steps > kMostSteps) {
    throw Error(Fault::usage, "usage.smooth",
                "--smooth " + number_text(sigma_mm) + ": curvature flow over so many voxels takes too long",
                "choose at most " + number_text(finest_mm * std::sqrt(2 * kStep * kMostSteps), 2) +
                    " mm, or --smoothing gaussian");
  }
  using Filter = itk::CurvatureFlowImageFilter<FloatImage, FloatImage>;
  auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetUseImageSpacing(true);
  filter->SetTimeStep(time / steps);
  filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(steps));
  return output_of(*filter);
}

FloatImage::Pointer smooth(const FloatImage::Pointer& image, double sigma_mm, Smoothing how) {
  const auto size = image->GetLargestPossibleRegion().GetSize();
  double extent_mm = 0;
  double finest_mm = std::numeric_limits<double>::infinity();
  for (unsigned axis = 0; axis < 3; ++axis) {
    extent_mm = std::max(extent_mm, static_cast<double>(size[axis]) * image->GetSpacing()[axis]);
    finest_mm = std::min(finest_mm, image->GetSpacing()[axis]);
  }
  if (!(sigma_mm < extent_mm)) {
    throw Error(Fault::usage, "usage.smooth",
                "--smooth " + number_text(sigma_mm) + ": the image is only " + number_text(extent_mm) + " mm long",
                "one or two voxels take out most noise: here " + number_text(finest_mm) + " mm or twice that");
  }
  return how == Smoothing::gaussian ? gaussian(image, sigma_mm, finest_mm) : curvature_flow(image, sigma_mm, finest_mm);
}

FloatImage::Pointer resample(const FloatImage::Pointer& image, double spacing_mm) {
  const auto size = image->GetLargestPossibleRegion().GetSize();
  FloatImage::SizeType new_size;
  FloatImage::SpacingType new_spacing;
  double voxels = 1;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const double length_mm = static_cast<double>(size[axis] - 1) * image->GetSpacing()[axis];
    const double steps = std::round(length_mm / spacing_mm);
    voxels *= steps + 1;
    if (steps < 1 || voxels > kMostVoxels) {
      throw Error(Fault::usage, "usage.resample",
                  "--resample " + number_text(spacing_mm) + ": that is " +
                      (steps < 1 ? "more than the image is long along an axis" : "more than 4e9 voxels"),
                  "the image's voxels are " + number_text(image->GetSpacing()[axis]) + " mm apart along this axis");
    }
    new_size[axis] = static_cast<itk::SizeValueType>(steps) + 1;
    new_spacing[axis] = length_mm / steps;
  }
  auto filter = itk::ResampleImageFilter<FloatImage, FloatImage>::New();  // linear between voxels
  filter->SetInput(image);
  filter->SetSize(new_size);
  filter->SetOutputSpacing(new_spacing);
  filter->SetOutputOrigin(image->GetOrigin());
  filter->SetOutputDirection(image->GetDirection());
  using Nearest = itk::NearestNeighborExtrapolateImageFunction<FloatImage, double>;
  filter->SetExtrapolator(Nearest::New());  // where rounding takes the last voxel beyond the border
  return output_of(*filter);
}

/// The values in a type that holds them.
template <class Voxel>
std::vector<Voxel> values_of(const FloatImage& image) {
  const float* values = image.GetBufferPointer();
  const auto count = image.GetLargestPossibleRegion().GetNumberOfPixels();
  std::vector<Voxel> result(count);
  std::transform(values, values + count, result.begin(), [](float value) { return static_cast<Voxel>(value); });
  return result;
}

}  // namespace

Scan simplified(const Scan& read, const Simplification& how) {
  Scan scan = how.crop ? cropped(read, *how.crop) : read;
  if (!how.changes_values()) return scan;
  FloatImage::Pointer image = to_image(scan);
  if (how.median_voxels > 0) image = median(image, how.median_voxels);
  if (how.smooth_mm) image = smooth(image, *how.smooth_mm, how.smoothing);
  if (how.resample_mm) image = resample(image, *how.resample_mm);

  std::array<int, 3> size{};
  std::array<Vec, 3> columns;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<unsigned>(axis);
    size[axis] = static_cast<int>(image->GetLargestPossibleRegion().GetSize()[n]);
    columns[axis] = (image->GetSpacing()[n] / scan.frame.spacing_mm(axis)) * scan.frame.column(axis);
  }
  const Frame frame = size == scan.size ? scan.frame : Frame(columns, scan.frame.origin());
  Scan result = std::visit(
      [&]<class Voxel>(const Voxel*) {
        constexpr bool kFits = std::is_integral_v<Voxel> && sizeof(Voxel) <= 2;
        if constexpr (kFits) {
          if (!how.smooth_mm && !how.resample_mm) return make_scan(values_of<Voxel>(*image), size, frame);
        }
        return make_scan(values_of<float>(*image), size, frame);
      },
      scan.voxels);
  result.format = scan.format;
  return result;
}

}  // namespace scantet
