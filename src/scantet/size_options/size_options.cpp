// Defaults stand in the struct; the texts stand here and nowhere else.
#include "scantet/size_options/size_options.h"

#include "scantet/base/options.h"
#include "scantet/size_options/size_request.h"

namespace scantet {
namespace {

const char* const kSizes = "Sizes and shapes";

}  // namespace

void declare_size_options(OptionSet& options, SizeOptions& sizes) {
  const std::string kinds = "auto, a file or a formula";
  const auto check = [](const OptionValue& value) { read_size(value.place, value.text); };
  options.add(
      "size", sizes.size, Range::above(0), kinds, check,
      {kSizes, "SIZE", "a size in mm",
       "Largest circumradius of a tetrahedron: a number in mm; auto, from the shape of the boundary, with no bound "
       "inside; an image of sizes in mm; or a formula in x, y, z, d (distance to the boundary, mm) and region, "
       "such as \"1 + 0.2*d\". The number of vertices grows as 1/size^3.",
       0, "that of the input; for an image 2 x its smallest voxel spacing"});
  options.add(
      "boundary-size", sizes.boundary_size, Range::above(0), kinds, check,
      {kSizes, "SIZE", "a size in mm",
       "Size on the boundary, where it is to be less than inside; it grows inward by 1 mm each mm. As --size; in a "
       "formula d is 0.",
       0, "as --size"});
  options.add("region-size", sizes.region_sizes,
              {kSizes, "R=MM", "a region and a size in mm",
               "Size in one region, instead of --size: \"2=1.5\", or by its name, \"skull=1.5\"."});
  options.add("size-where", sizes.size_where,
              {kSizes, "PLACE=MM", "a place and a size in mm",
               "Size in one place, instead of --size and --region-size: \"ball(0, 0, 90, 12)=1.5\", \"z < -40 and not "
               "box(0, 0, -60, 9, 9, -50)=2\", \"scan(\"pet.nrrd\") > 3=1\" (docs/places.md). Where places "
               "overlap, the smallest size holds."});
  options.add(
      "layers", sizes.layers,
      {kSizes, "N[,R...]", "a number of layers",
       "At least so many tetrahedra across every part of the regions named or numbered, or of all: where a part is "
       "thin, "
       "the size is made smaller, down to parts half a voxel thick. \"2,skull\". Where the mesh does not keep it, exit "
       "status 4 and the places."});
  options.add("target-tets", sizes.target_tets, Range::at_least(1),
              {kSizes, "N", "a number of tetrahedra",
               "Chooses the size, one everywhere, such that the mesh is expected to have about so many tetrahedra "
               "(--plan says how far off that may be). Instead of --size."});
  options.add(
      "least-size", sizes.least_mm, Range::above(0),
      {kSizes, "MM", "a size in mm",
       "Smaller sizes that auto, a formula or an image give are raised to this. It bounds sizes, not edges: where the "
       "surface is narrower than the size, its topology takes shorter ones, and a note says so.",
       0, "for auto the smallest voxel spacing, or a 200th of an object that is no image; else none"});
  options.add("feature-share", sizes.feature_share, Range::above(0),
              {kSizes, "X", "a factor",
               "The size that auto gives is this share of the distance to the medial axis. Proofs ask for 0.09.", 0,
               number_text(kFeatureShare)});
  options.add(
      "lipschitz", sizes.lipschitz_k, Range::above(0),
      {kSizes, "K", "a slope",
       "Lets auto go by the Lipschitz radius, within which the boundary is nowhere steeper than K over some plane: "
       "at edges it is not 0 as the distance to the medial axis. 1 takes in edges of 90 degrees; proofs ask for "
       "less than 0.336.",
       0, "none: auto goes by the distance to the medial axis"});
}

}  // namespace scantet
