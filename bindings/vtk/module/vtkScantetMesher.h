/// A filter of VTK's that meshes an image.
#ifndef vtkScantetMesher_h
#define vtkScantetMesher_h

#include <vtkUnstructuredGridAlgorithm.h>

#include <memory>

#include "vtkScantetModule.h"

class vtkPolyData;

/// Image in, tetrahedra out: what `scantet mesh` does, as a step of a pipeline, with the same mesh.
///
/// Input: vtkImageData with one number a point, the active scalars or SetInputArrayToProcess(); not copied.
/// Output 0: vtkUnstructuredGrid of tets. Cell arrays: `region` (int), and of doubles the measures of each tet
/// (docs/fields.md: `min_dihedral_deg` …) and the fields of the option `field`. Point array: `on_boundary` (0 or 1).
/// Arrays `set_NAME` of the option `set`. Field data: `region_ids` and `region_names`; `findings`: bounds not kept and
/// faults found, each a warning, too; `notes`; `report`: all that was measured, as JSON.
/// Output 1: vtkPolyData of the boundary's triangles, with the points of output 0. Cell arrays: `patch` (index into the
/// field data `patch_names`) and `regions`, behind the triangle and before it; 0 is outside. Of elements of second
/// order the triangles between corners.
///
/// Options are those of the command, by name, without dashes: SetOption("min-dihedral", "12"). They are checked when
/// they are set (the name) and used (the value). Level and size are most often all that is needed.
///
/// Observers are told of progress (ProgressEvent) on the thread that calls Update(). SetAbortExecute(1), from an
/// observer or another thread, ends the run within about a second; both outputs are empty then. As other filters of
/// VTK's it runs again when it was modified.
/// What makes no sense is told as VTK does (ErrorEvent), and kept in GetErrorText(); Update() leaves empty outputs.
class VTKSCANTET_EXPORT vtkScantetMesher : public vtkUnstructuredGridAlgorithm {
 public:
  static vtkScantetMesher* New();
  vtkTypeMacro(vtkScantetMesher, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The option has this value alone. A flag takes "true" and "false"; "none" stands for none where the option knows
  /// that. Return: whether there is such an option; if not, that is an error that names the closest.
  bool SetOption(const char* name, const char* value);
  /// One more value of an option that may be given several times: "level", "set", "field" …
  bool AddOption(const char* name, const char* value);
  /// The option has its default value again.
  void RemoveOption(const char* name);
  /// All options have.
  void ClearOptions();
  /// The first value given; null: none is.
  const char* GetOption(const char* name);

  /// The options that there are: how many, what each is called, and what it is for, with its default.
  static int GetNumberOfOptions();
  static const char* GetOptionName(int index);
  static const char* GetOptionHelp(const char* name);

  /// Where the surface is, in the units of the voxels: option "level".
  void SetLevel(double level);
  /// How large tets may be, mm: option "size".
  void SetSize(double size);
  /// Which labels of a segmentation are meshed, "all" or "1,3,7-12": option "labels".
  void SetLabels(const char* labels);
  /// The smallest dihedral angle, degrees: option "min-dihedral".
  void SetMinDihedral(double degrees);
  /// A Gaussian of this width, mm, before all else: option "smooth".
  void SetSmooth(double width);
  /// 0: one a core; the mesh does not depend on it: option "threads".
  void SetThreads(int threads);

  enum { LPS = 0, RAS = 1 };
  /// How the world axes of the image lie, of which VTK itself says nothing: LPS (the default) as ITK and DICOM have
  /// them, RAS as NIfTI and 3D Slicer do. The mesh has the same; formulas and sets of options are in LPS.
  vtkSetClampMacro(Axes, int, LPS, RAS);
  vtkGetMacro(Axes, int);

  /// Whether the measures of each tet are among the cell arrays. Default: they are.
  vtkSetMacro(QualityArrays, bool);
  vtkGetMacro(QualityArrays, bool);
  vtkBooleanMacro(QualityArrays, bool);

  /// Output 1.
  vtkPolyData* GetBoundary();
  /// Of the last run: "code: what is wrong; what to do". Empty: nothing was.
  const char* GetErrorText();

 protected:
  vtkScantetMesher();
  ~vtkScantetMesher() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

 private:
  vtkScantetMesher(const vtkScantetMesher&) = delete;
  void operator=(const vtkScantetMesher&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
  int Axes = LPS;
  bool QualityArrays = true;
};

#endif
