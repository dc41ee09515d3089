#include "vtkTetQualityHistogram.h"

#include <scantet/base/error.h>
#include <scantet/base/options.h>
#include <scantet/quality/quality.h>
#include <scantet/report/named_distributions.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <vector>

#include "grids.h"

vtkStandardNewMacro(vtkTetQualityHistogram);

namespace {

using Named = std::vector<scantet::NamedDistribution>;

/// A column; value(i) is that of row i.
template <class Array, class Value>
void add_column(vtkTable& table, const std::string& name, std::size_t rows, const Value& value) {
  vtkNew<Array> column;
  column->SetName(name.c_str());
  column->SetNumberOfValues(static_cast<vtkIdType>(rows));
  for (std::size_t i = 0; i < rows; ++i) {
    column->SetValue(static_cast<vtkIdType>(i), value(i));
  }
  table.AddColumn(column);
}

void fill_histogram(const scantet::Histogram& histogram, vtkTable& table) {
  const std::size_t bins = histogram.counts.size();
  add_column<vtkDoubleArray>(table, "bin_low", bins, [&](std::size_t i) { return histogram.edges[i]; });
  add_column<vtkDoubleArray>(table, "bin_high", bins, [&](std::size_t i) { return histogram.edges[i + 1]; });
  add_column<vtkTypeInt64Array>(table, "count", bins, [&](std::size_t i) { return histogram.counts[i]; });
}

void fill_statistics(const Named& named, vtkTable& table) {
  const std::size_t rows = named.size();
  const auto of = [&](std::size_t i) -> const scantet::Distribution& { return *named[i].distribution; };
  add_column<vtkStringArray>(table, "measure", rows, [&](std::size_t i) { return std::string(named[i].name); });
  add_column<vtkTypeInt64Array>(table, "count", rows, [&](std::size_t i) { return of(i).count; });
  add_column<vtkTypeInt64Array>(table, "infinite", rows, [&](std::size_t i) { return of(i).infinite; });
  add_column<vtkDoubleArray>(table, "min", rows, [&](std::size_t i) { return of(i).min; });
  add_column<vtkDoubleArray>(table, "max", rows, [&](std::size_t i) { return of(i).max; });
  add_column<vtkDoubleArray>(table, "mean", rows, [&](std::size_t i) { return of(i).mean; });
  for (std::size_t p = 0; p < scantet::kPercentiles.size(); ++p) {
    add_column<vtkDoubleArray>(table, "p" + std::to_string(scantet::kPercentiles[p]), rows,
                               [&](std::size_t i) { return of(i).percentiles[p]; });
  }
}

const scantet::Distribution& find_measure(const Named& named, const std::string& name) {
  std::vector<std::string> names;
  for (const scantet::NamedDistribution& one : named) {
    if (one.name == name) return *one.distribution;
    names.emplace_back(one.name);
  }
  const auto meant = scantet::closest_name(name, names);
  throw scantet::Error(scantet::Fault::usage, "usage.measure", "there is no measure \"" + name + "\"",
                       meant ? "did you mean \"" + *meant + "\"?" : "output 1 lists the measures");
}

}  // namespace

vtkTetQualityHistogram::vtkTetQualityHistogram() {
  this->SetNumberOfOutputPorts(2);
}

vtkTable* vtkTetQualityHistogram::GetStatistics() {
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkTetQualityHistogram::FillInputPortInformation(int, vtkInformation* info) {
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

int vtkTetQualityHistogram::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
  vtkTable* const histogram = vtkTable::GetData(outputs, 0);
  vtkTable* const statistics = vtkTable::GetData(outputs, 1);
  histogram->Initialize();
  statistics->Initialize();
  try {
    const scantet::TetMesh mesh = vtkscantet::tets_of(*vtkUnstructuredGrid::GetData(inputs[0]));
    if (mesh.tets.empty()) {
      throw scantet::Error(scantet::Fault::input, "input.empty_mesh", "the grid has no tetrahedra",
                           "give one that has");
    }
    const scantet::QualitySummary quality = scantet::measure_quality(mesh);
    const Named named = scantet::named_distributions(quality);
    const scantet::Distribution& chosen = find_measure(named, this->Measure);
    fill_histogram(chosen.histogram, *histogram);
    fill_statistics(named, *statistics);
    return 1;
  } catch (const scantet::Error& error) {
    vtkErrorMacro(<< error.code() << ": " << error.what());
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
  }
  return 0;
}

void vtkTetQualityHistogram::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Measure: " << this->Measure << "\n";
}
