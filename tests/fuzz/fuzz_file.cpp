// The bytes that libFuzzer makes, through one reader: as a file of the reader's name, or as the text of an option. An
// Error is what damaged bytes are expected to end in, and anything else that ends the run is a fault. Compiled once a
// kind: SCANTET_FUZZ_KIND chooses the reader, SCANTET_FUZZ_NAME is how its files end. Readers that work in a child
// process are called by themselves, without the child, as far as they are ours; of those that a library is behind, our
// checks before it are.
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "implicit/formula.h"
#include "polyhedron/edge_lines.h"
#include "scantet/app/config.h"
#include "scantet/base/error.h"
#include "scantet/cuts/cut_text.h"
#include "scantet/io/mesh_io.h"
#include "scantet/labels/label_choice.h"
#include "scantet/labels/label_names.h"
#include "scantet/materials/material_file.h"
#include "scantet/places/place.h"
#include "scantet/plugin/plugin_loader.h"
#include "scantet/reading/dicom_outline_impl.h"
#include "scantet/reading/image_source_impl.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/reading/text_header_impl.h"
#include "scantet/sizing/size_formula.h"
#include "scantet/verification/verify_job.h"

namespace {

using namespace scantet;

struct Input {
  const std::string& path;  // of a file that holds the text
  const std::string& text;
};
using Reader = std::function<void(const Input&)>;

const PluginRegistry& plugins() {
  static const PluginRegistry all = [] {
    PluginRegistry registry;
    load_plugin_folder(plugin_folder(), registry);
    return registry;
  }();
  return all;
}

void read_plugin_file(const Input& input) {
  Progress progress;
  plugins().create_for(input.path)->info(input.path, progress);
}

void read_mesh_file(const Input& input) {
  read_mesh(input.path);
}

/// The voxels, too, if they are not many.
void read_source(ImageSource& source) {
  constexpr double kMostBytes = 1 << 24;
  const ImageHeader& header = source.header();
  if (!header.type) return;
  double bytes = voxel_bytes(*header.type) * header.components;
  for (const std::int64_t n : header.size) bytes *= static_cast<double>(n);
  if (!(bytes >= 0 && bytes <= kMostBytes)) return;
  std::vector<char> voxels(static_cast<std::size_t>(bytes));
  Progress progress;
  source.read(voxels.data(), progress);
}

void read_segmentation(const Input& input) {
  if (!outline_of(input.path).problem.empty() || !is_dicom_segmentation(input.path)) return;
  read_source(*open_dicom_segmentation(input.path));
}

void read_certificate_file(const Input& input) {
  VerifyJob job;
  job.certificate = input.path;
  recorded_job(job, {});
}

void read_implicit_formula(const Input& input) {
  const implicit::Formula formula(input.text);
  formula(0.5, -0.25, 2);
  formula(implicit::Interval{-1, 1}, implicit::Interval{0, 2}, implicit::Interval{-3, -2});
}

void read_size_formula(const Input& input) {
  const SizeFormula formula(input.text, "--size");
  const std::array<SizePlace, 2> places{SizePlace{{1, 2, 3}, 0.5, 1}, SizePlace{{-1, 0, 0}, 0, 2}};
  std::array<double, 2> sizes{};
  formula.sizes_at(places, sizes);
}

/// Throws of one form are no reason not to try the other.
void read_both_places(const Input& input) {
  try {
    read_place("--size-where", input.text);
  } catch (const Error&) {
  }
  read_named_place("--set", input.text);
}

void read_both_tables(const Input& input) {
  try {
    read_label_choice("--labels", input.path);
  } catch (const Error&) {
  }
  read_label_table(input.path);
}

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> all{
      {"nii", [](const Input& input) { read_source(*open_nifti_image(input.path)); }},
      {"nrrd", [](const Input& input) { check_text_header(input.path); }},
      {"mha", [](const Input& input) { check_text_header(input.path); }},
      {"tif", [](const Input& input) { read_source(*open_tiff_stack(input.path)); }},
      {"dcm", read_segmentation},
      {"seg",  // in a child: what is told of it is judged here
       [](const Input& input) {
         Progress progress;
         read_scan(input.path, progress);
       }},
      {"msh", read_mesh_file},
      {"mesh", read_mesh_file},
      {"inp", read_mesh_file},
      {"vtu", read_mesh_file},
      {"vtk", read_mesh_file},
      {"json", [](const Input& input) { read_config(input.path); }},
      {"materials", [](const Input& input) { read_material_file(input.path); }},
      {"certificate", read_certificate_file},
      {"labels", read_both_tables},
      {"lines", [](const Input& input) { polyhedron::read_edge_lines(input.path); }},
      {"polylines", [](const Input& input) { polyhedron::read_edge_lines(input.path); }},
      {"off", read_plugin_file},
      {"obj", read_plugin_file},
      {"ply", read_plugin_file},
      {"stl", read_plugin_file},
      {"xyz", read_plugin_file},
      {"vdb", read_plugin_file},
      {"formula", read_implicit_formula},
      {"size", read_size_formula},
      {"place", read_both_places},
      {"cut",
       [](const Input& input) {
         std::vector<CutPlane> planes;
         read_cut("--cut", input.text, planes);
       }},
  };
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static const std::string path = "/tmp/scantet_fuzz_" + std::to_string(getpid()) + SCANTET_FUZZ_NAME;
  static const Reader& read = readers().at(SCANTET_FUZZ_KIND);
  const std::string text(reinterpret_cast<const char*>(bytes), count);
  std::ofstream(path, std::ios::binary) << text;
  try {
    read({path, text});
  } catch (const scantet::Error&) {
    return 0;
  }
  return 0;
}
