// The ways along which narrow parts of a trilinear level set hang together.
#pragma once

#include "scantet/domain/domain.h"
#include "scantet/field/height_grid.h"

namespace scantet {

/// The segments that Domain::narrow_ways tells of, found in one sweep; nothing is kept.
///
/// By Morse theory, handles of {h > 0} stand at saddles of h above the level. Where two parts are joined by a thread, h
/// has a saddle that is its maximum across the thread and its minimum along it; a sheet is thinnest at a saddle that is
/// the maximum through the sheet and the minimum within. From a saddle h grows along the thread, or within the sheet,
/// to nodes of the grid, and from these along its edges. Such ways lie in {h > 0}, so a mesh that has them inside has
/// the thread, and no hole in the sheet there. The same holds of {h < 0} and -h: ways through tunnels and slits.
///
/// Ways begin at all such saddles (grid nodes, saddles of faces and in cells) at most a voxel from a cell through which
/// the level set passes, and end at a node whose six neighbours have its sign, or where h grows no more. Saddles within
/// a millionth of the heights around them from the level are left out. Where h is level, as it often is in a scan of
/// whole numbers, it counts as if it grew along the axes; in a scan with nodes at the level only if ground is_crossed.
///
/// sink: gets each segment once, in a fixed order, with region 1 for {h > 0} and kOutside for {h < 0}.
void narrow_ways(const HeightGrid& heights, const Frame& frame, LevelGround ground, const NarrowWaySink& sink);

}  // namespace scantet
