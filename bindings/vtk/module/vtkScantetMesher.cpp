// The options are kept as texts, and given to scantet as the command gives them.
#include "vtkScantetMesher.h"

#include <scantet/adapters/from_vtk.h>
#include <scantet/app/named_options.h>
#include <scantet/base/error.h>
#include <scantet/base/progress_share.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "grids.h"

vtkStandardNewMacro(vtkScantetMesher);

namespace {

const std::vector<scantet::Option>& declared() {
  static const std::vector<scantet::Option> options = scantet::named_mesh_options();
  return options;
}

const scantet::Option* find_option(const std::string& name) {
  for (const scantet::Option& option : declared()) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

std::string unknown_option(const std::string& name) {
  std::vector<std::string> names;
  for (const scantet::Option& option : declared()) names.push_back(option.name);
  const auto meant = scantet::closest_name(name, names);
  return "there is no option \"" + name + "\"" + (meant ? "; did you mean \"" + *meant + "\"?" : "");
}

/// Tells the filter's observers and asks whether it is to stop, on the thread that runs it: observers may be of Python.
class Watch final : public scantet::Progress {
 public:
  explicit Watch(vtkAlgorithm& filter) : filter_(filter) {}
  void report(const scantet::ProgressState& state) override {
    if (std::this_thread::get_id() != thread_) return;
    share_ = std::max(share_, scantet::progress_share(state));
    filter_.UpdateProgress(share_);
  }
  bool cancelled() const override {
    if (std::this_thread::get_id() == thread_ && filter_.GetAbortExecute() != 0) is_cancelled_ = true;
    return is_cancelled_;
  }

 private:
  vtkAlgorithm& filter_;
  const std::thread::id thread_ = std::this_thread::get_id();
  double share_ = 0;
  mutable std::atomic<bool> is_cancelled_{false};
};

}  // namespace

class vtkScantetMesher::vtkInternals {
 public:
  /// With the measures of tets, if they are wanted and nothing else is said of them.
  std::vector<scantet::OptionValue> values(bool quality_arrays) const {
    std::vector<scantet::OptionValue> all = given;
    const auto is_said = [](const scantet::OptionValue& value) { return value.name == "quality-fields"; };
    if (quality_arrays && std::none_of(given.begin(), given.end(), is_said)) {
      all.push_back({"quality-fields", "true", "QualityArrays"});
    }
    return all;
  }

  std::vector<scantet::OptionValue> given;
  std::string help;
  std::string error;
};

vtkScantetMesher::vtkScantetMesher() : Internals(std::make_unique<vtkInternals>()) {
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkScantetMesher::~vtkScantetMesher() = default;

bool vtkScantetMesher::AddOption(const char* name, const char* value) {
  const std::string option = name == nullptr ? "" : name;
  if (find_option(option) == nullptr) {
    vtkErrorMacro(<< unknown_option(option));
    return false;
  }
  this->Internals->given.push_back({option, value == nullptr ? "none" : value, option});
  this->Modified();
  return true;
}

bool vtkScantetMesher::SetOption(const char* name, const char* value) {
  const std::string option = name == nullptr ? "" : name;  // both may be of the list that changes
  const std::string text = value == nullptr ? "none" : value;
  const auto is_of_it = [&](const scantet::OptionValue& given) { return given.name == option; };
  const auto times = std::count_if(this->Internals->given.begin(), this->Internals->given.end(), is_of_it);
  if (times == 1 && text == this->GetOption(option.c_str())) return true;
  this->RemoveOption(option.c_str());
  return this->AddOption(option.c_str(), text.c_str());
}

void vtkScantetMesher::RemoveOption(const char* name) {
  auto& given = this->Internals->given;
  const std::string option = name == nullptr ? "" : name;
  if (std::erase_if(given, [&](const scantet::OptionValue& value) { return value.name == option; }) > 0) {
    this->Modified();
  }
}

void vtkScantetMesher::ClearOptions() {
  this->Internals->given.clear();
  this->Modified();
}

const char* vtkScantetMesher::GetOption(const char* name) {
  const std::string option = name == nullptr ? "" : name;
  for (const scantet::OptionValue& value : this->Internals->given) {
    if (value.name == option) return value.text.c_str();
  }
  return nullptr;
}

int vtkScantetMesher::GetNumberOfOptions() {
  return static_cast<int>(declared().size());
}

const char* vtkScantetMesher::GetOptionName(int index) {
  const bool is_there = index >= 0 && index < GetNumberOfOptions();
  return is_there ? declared()[static_cast<std::size_t>(index)].name.c_str() : nullptr;
}

const char* vtkScantetMesher::GetOptionHelp(const char* name) {
  const scantet::Option* const option = find_option(name == nullptr ? "" : name);
  return option == nullptr ? nullptr : option->text.help.c_str();
}

void vtkScantetMesher::SetLevel(double level) {
  this->SetOption("level", scantet::number_text(level).c_str());
}
void vtkScantetMesher::SetSize(double size) {
  this->SetOption("size", scantet::number_text(size).c_str());
}
void vtkScantetMesher::SetLabels(const char* labels) {
  this->SetOption("labels", labels);
}
void vtkScantetMesher::SetMinDihedral(double degrees) {
  this->SetOption("min-dihedral", scantet::number_text(degrees).c_str());
}
void vtkScantetMesher::SetSmooth(double width) {
  this->SetOption("smooth", scantet::number_text(width).c_str());
}
void vtkScantetMesher::SetThreads(int threads) {
  this->SetOption("threads", std::to_string(threads).c_str());
}

vtkPolyData* vtkScantetMesher::GetBoundary() {
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

const char* vtkScantetMesher::GetErrorText() {
  return this->Internals->error.c_str();
}

int vtkScantetMesher::FillInputPortInformation(int, vtkInformation* info) {
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkScantetMesher::FillOutputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

// The whole image is needed, whatever is asked of the mesh.
int vtkScantetMesher::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*) {
  vtkInformation* const info = inputs[0]->GetInformationObject(0);
  int extent[6];
  if (info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()) != 0) {
    info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
  }
  return 1;
}

int vtkScantetMesher::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
  vtkUnstructuredGrid* const grid = vtkUnstructuredGrid::GetData(outputs, 0);
  vtkPolyData* const boundary = vtkPolyData::GetData(outputs, 1);
  grid->Initialize();
  boundary->Initialize();
  this->Internals->error.clear();
  try {
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->ShallowCopy(vtkImageData::GetData(inputs[0]));
    vtkDataArray* const chosen = this->GetInputArrayToProcess(0, inputs);
    if (chosen == nullptr) {
      throw scantet::Error(scantet::Fault::input, "input.pixel_type", "the image has no such scalars at its points",
                           "choose one of its point arrays with SetInputArrayToProcess()");
    }
    image->GetPointData()->SetScalars(chosen);
    const auto axes = this->Axes == RAS ? scantet::VtkAxes::ras : scantet::VtkAxes::lps;
    Watch watch(*this);
    const scantet::MeshOutcome outcome = scantet::mesh_scan_named(scantet::scan_from_vtk(image, axes),
                                                                  this->Internals->values(this->QualityArrays), watch);
    if (outcome.cancelled) return 1;
    vtkscantet::fill_grid(outcome, axes, *grid);
    vtkscantet::fill_boundary(outcome, *grid, *boundary);
    for (const std::string& finding : outcome.findings) vtkWarningMacro(<< finding);
    return 1;
  } catch (const scantet::Error& error) {
    this->Internals->error = error.code() + ": " + error.what();
  } catch (const std::exception& error) {
    this->Internals->error = error.what();
  }
  vtkErrorMacro(<< this->Internals->error);
  return 0;
}

void vtkScantetMesher::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Axes: " << (this->Axes == RAS ? "RAS" : "LPS") << "\n";
  os << indent << "QualityArrays: " << (this->QualityArrays ? "on" : "off") << "\n";
  for (const scantet::OptionValue& value : this->Internals->given) {
    os << indent << "Option " << value.name << ": " << value.text << "\n";
  }
}
