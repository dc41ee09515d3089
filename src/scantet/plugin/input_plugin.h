// How inputs become domains, and files of another kind: the interface that every opener implements, ours for images
// through ITK included.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/color.h"
#include "scantet/base/frame.h"
#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/base/run_account.h"
#include "scantet/base/triangle_surface.h"
#include "scantet/cuts/cut_plane.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/facet_sizes.h"
#include "scantet/domain/region_grid.h"
#include "scantet/field/grid_field.h"
#include "scantet/plugin/input_info.h"

namespace SCANTET_API scantet {

/// Raised with every change of InputPlugin or of a type it names.
inline constexpr int kInputPluginVersion = 13;

struct FittedDomain;

/// Moves the boundary by a little, such that a mesh whose vertices follow gets the volumes of the input. Given: the
/// volumes that the mesh's regions have, mm³, without those of regions that have none; and places, world mm, around
/// which the boundary stays as it is. Curves and corners stay. Without a domain if the volumes are right, or cancelled.
using Settling = std::function<FittedDomain(const std::map<Region, double>&, std::span<const Point>, Progress&)>;

/// What OpenedDomain::fit() makes.
struct FittedDomain {
  std::unique_ptr<Domain> domain;      ///< null if progress.cancelled() became true
  std::function<RegionGrid()> grid{};  ///< as OpenedDomain::grid
  std::vector<PhaseAccount> phases{};  ///< as OpenedDomain::phases
  Settling settle{};                   ///< of this domain; null if its boundary is where it must be
};

/// What open() makes of an input. Lengths are mm, places world, LPS for images.
struct OpenedDomain {
  std::unique_ptr<Domain> domain;              ///< null if progress.cancelled() became true
  std::optional<Frame> frame;                  ///< index to world, mm, if the input is a grid
  double default_size_mm = 0;                  ///< σ when the user asks for none; > 0 and finite
  std::string default_size_reason;             ///< "2 x the smallest voxel spacing"
  std::vector<std::string> files;              ///< every file that was read, for the report's checksum; may be none
  std::optional<double> min_size_mm{};         ///< smaller sizes are refused, as finer than the input can tell; > 0
  std::string min_size_reason{};               ///< "the points are 2 mm apart on average"
  std::optional<DroppedComponents> dropped{};  ///< for the report, if the user asked to leave components out
  std::vector<std::string> notes{};            ///< what else the user should know; a sentence each, no full stop
  std::map<Region, Color> colors{};            ///< of regions, as the input has them, for reports; may lack any
  std::function<RegionGrid()> grid{};          ///< of an input that is a grid of regions: that, for the audit; or null
  /// Makes domain and grid anew once the sizes of facets are known, for an input that leaves open where its boundary
  /// runs between voxels: so that facets, which cut off what is round, leave the volumes right. Null otherwise.
  std::function<FittedDomain(const FacetSizes&, Progress&)> fit{};
  Settling settle{};                   ///< of the domain that fit() made; null before
  std::vector<PhaseAccount> phases{};  ///< parts of open() that are worth telling, of the stage "read"
  std::vector<CutPlane> border{};      ///< where the input ends, for --border cap; none if it has no border
};

/// Opens one family of inputs. An object serves one job: it holds the values of its own options, so that two jobs never
/// share state. Used from one thread at a time.
class InputPlugin {
 public:
  virtual ~InputPlugin() = default;

  /// Short, unique among the plugins: "image".
  virtual std::string name() const = 0;
  /// One sentence: what it opens.
  virtual std::string description() const = 0;
  /// How well it can open the input: 0 not at all, 100 certainly. input: as typed, mostly a path; it need not exist.
  /// Looks at the name and the first bytes only; throws nothing.
  virtual int can_open(const std::string& input) const = 0;
  /// Declares its options, with fields of this object as targets: `options` is not used once this object is gone. Names
  /// should not repeat those of `scantet mesh`; load_plugin() refuses those of PluginRegistry::taken_options().
  virtual void declare_options(OptionSet& options) = 0;
  /// Planes that will cut what open() makes, told before it; an input that knows nothing between its samples may choose
  /// what there is at them. Default: they make no difference.
  virtual void expect_cuts(const std::vector<CutPlane>& /*planes*/) {}
  /// Opens the input with the options as they are. input: as of can_open(). progress: reported to, and polled.
  /// Throws Error (Fault::usage for options, Fault::input for the data), with codes of its own.
  virtual OpenedDomain open(const std::string& input, Progress& progress) = 0;
  /// What there is to know about the input before meshing, for `scantet info`, in the order to be shown; empty if
  /// cancelled. Throws as open().
  virtual std::vector<InfoSection> info(const std::string& input, Progress& progress) = 0;

  /// The input as a field that is trilinear between voxels, for `scantet verify`, of the grid that its options choose;
  /// nullopt if it is of another kind, or cancelled. Throws as open(). Default: of another kind.
  virtual std::optional<GridField> field(const std::string& /*input*/, Progress& /*progress*/) { return std::nullopt; }

  /// The input as a closed surface of triangles, for `scantet verify`, as its options say; nullopt and throws likewise.
  virtual std::optional<TriangleSurface> surface(const std::string& /*input*/, Progress& /*progress*/) {
    return std::nullopt;
  }

  /// How well it can turn the input into the file `output`, for `scantet convert`: 0 to 100 as can_open(). Throws
  /// nothing. Default: not at all.
  virtual int can_convert(const std::string& /*input*/, const std::string& /*output*/) const { return 0; }
  /// Declares the options of convert(), as declare_options() does those of open() and info(). Names should not repeat
  /// those of `scantet convert`. Default: none.
  virtual void declare_convert_options(OptionSet& /*options*/) {}
  /// Writes `output`, whole or not at all (AtomicFile). Called only if can_convert() is above 0. Return: false if
  /// progress.cancelled() became true; nothing is written then. Throws Error: as open(), and with Fault::output.
  virtual bool convert(const std::string& /*input*/, const std::string& /*output*/, Progress& /*progress*/) {
    return false;
  }
};

}  // namespace scantet
