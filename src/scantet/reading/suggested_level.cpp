// ITK's calculator on the histogram of scan_statistics, so that the voxels are counted in their own type, without a
// copy.
#include "scantet/reading/suggested_level.h"

#include <itkHistogram.h>
#include <itkOtsuThresholdCalculator.h>

#include <cmath>

#include "scantet/field/scan_statistics.h"

namespace scantet {

double suggested_level(const Scan& scan) {
  using ItkHistogram = itk::Statistics::Histogram<double>;
  const ValueHistogram histogram = histogram_of(scan);
  auto counts = ItkHistogram::New();
  counts->SetMeasurementVectorSize(1);
  ItkHistogram::SizeType size(1);
  size[0] = histogram.counts.size();
  ItkHistogram::MeasurementVectorType low(1);
  ItkHistogram::MeasurementVectorType high(1);
  low[0] = histogram.lower;
  high[0] = histogram.lower + histogram.bin_width * static_cast<double>(histogram.counts.size());
  counts->Initialize(size, low, high);
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) counts->SetFrequency(bin, histogram.counts[bin]);

  auto otsu = itk::OtsuThresholdCalculator<ItkHistogram, double>::New();
  otsu->SetInput(counts);
  otsu->SetReturnBinMidpoint(false);  // the edge between the last bin below and the first above
  otsu->Update();
  const double edge = otsu->GetThreshold();

  // Every level in a gap between values splits them alike; ITK gives the lowest, the middle is the safest.
  auto bin = static_cast<std::size_t>(std::lround((edge - histogram.lower) / histogram.bin_width));
  while (bin < histogram.counts.size() && histogram.counts[bin] == 0) ++bin;
  return (edge + histogram.lower + histogram.bin_width * static_cast<double>(bin)) / 2;
}

}  // namespace scantet
