// VTK writes each message twice: to its output window, which is replaced here, and to its log on standard error, which
// is turned off meanwhile. Warnings are dropped: the results of the readers and writers are checked for themselves.
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <mutex>

#include "scantet/io/vtk_messages_impl.h"

namespace scantet {
namespace {

std::mutex g_one_at_a_time;

class ErrorCollector final : public vtkOutputWindow {
 public:
  static ErrorCollector* New();

  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    const std::lock_guard<std::mutex> lock(mutex_);  // VTK's workers may report too
    if (first_error_.empty()) first_error_ = text;
  }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  std::string first_error() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return first_error_;
  }

 protected:
  ErrorCollector() = default;

 private:
  mutable std::mutex mutex_;
  std::string first_error_;
};
vtkStandardNewMacro(ErrorCollector)

    /// "ERROR: In file.cxx, line 7\nvtkThing (0x55): It broke\n" becomes "It broke".
    std::string plain(std::string text) {
  const std::size_t object = text.find("): ");
  if (object != std::string::npos) text.erase(0, object + 3);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

}  // namespace

struct VtkMessages::State {
  std::lock_guard<std::mutex> lock{g_one_at_a_time};
  vtkLogger::Verbosity verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  vtkSmartPointer<vtkOutputWindow> previous = vtkOutputWindow::GetInstance();
  vtkNew<ErrorCollector> collector;
};

VtkMessages::VtkMessages() : state_(std::make_unique<State>()) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkOutputWindow::SetInstance(state_->collector);
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(state_->previous);
  vtkLogger::SetStderrVerbosity(state_->verbosity);
}

bool VtkMessages::failed() const {
  return !state_->collector->first_error().empty();
}

std::string VtkMessages::first_error() const {
  return plain(state_->collector->first_error());
}

}  // namespace scantet
