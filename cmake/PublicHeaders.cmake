# The library's face: what is installed, and what others may include. Everything else is private, and its symbols are
# hidden. `ctest -L architecture` holds these lists against the code: a public header includes public headers alone,
# scantet/scantet.h includes what users need, and plugins/ include nothing else. docs/architecture.md says for each header
# that no other of these includes what it is for.

# What a program needs that makes meshes: all that scantet/scantet.h includes.
set(scantet_user_headers
  base/api.h base/color.h base/error.h base/frame.h base/geometry.h base/mesh_order.h base/options.h base/progress.h base/progress_share.h base/run_account.h base/stratum.h base/tet_mesh.h base/triangle_surface.h
  base/version.h
  cuts/cut_domain.h cuts/cut_plane.h domain/analytic.h domain/component.h domain/cone_tree.h domain/curve.h domain/domain.h domain/facet_sizes.h domain/region_grid.h domain/rule_bounds.h domain/sizing_field.h
  field/grid_field.h field/level_settings.h field/scan.h field/scan_from_memory.h fields/scan_field.h
  reading/crop.h reading/scan_reader.h reading/simplify.h reading/suggested_level.h
  labels/label_object.h labels/label_settings.h
  image/level_set.h image/nested_level_sets.h
  refine/mesh_result.h refine/mesher.h refine/mesher_options.h
  optimize/element_bounds.h optimize/optimizer.h
  quality/quality.h quality/quality_fields.h
  check/audit.h check/conformance.h check/distance.h check/layers.h check/loss_count.h
  certificate/certificate_text.h verify/label_source.h verify/labels.h verify/surfaces.h verify/verify.h
  io/mesh_io.h
  report/named_distributions.h report/report.h report/report_forms.h report/report_model.h report/report_regions.h report/report_scan.h report/report_theory.h
  second_order/second_order.h size_options/size_options.h
  app/cut_options.h app/mesh_request.h app/mesh_scan.h app/meshing.h app/named_options.h)

# What a plugin needs beside these: its interface, what makes queries fast, and trilinear fields for other stores of values.
set(scantet_plugin_headers
  base/box_clip.h base/child_process.h base/file_extension.h base/memory.h base/parallel.h base/trilinear.h
  domain/boundary_cells.h domain/clearance_grid.h
  field/at_level_count.h field/bernstein_cubic.h field/block_signs.h field/cell_walk.h field/height_grid.h field/shared_cells.h field/trilinear_cell.h
  field/values_at_level.h
  topology/level_topology.h
  image/crossing_writer.h image/surface_scan.h image/trilinear_cells.h image/trilinear_domain.h
  io/atomic_file.h
  scan_input/clear_levels.h scan_input/label_input.h
  plugin/input_info.h plugin/input_plugin.h plugin/plugin.h plugin/plugin_check.h plugin/plugin_loader.h plugin/plugin_registry.h)

# These show third parties' types, to those who include them.
set(scantet_adapter_headers adapters/from_itk.h adapters/from_vtk.h adapters/itk_mesh_filter.h)
