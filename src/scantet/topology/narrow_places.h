// Where a trilinear level set is thinner than a voxel.
#pragma once

#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/field/height_grid.h"

namespace scantet {

/// The places that Domain::size_hints() tells of, found in one sweep; nothing is kept.
///
/// They are the saddles of the field, the function in all cells around taken into account: a point is one if moving the
/// level past its height joins or parts something there. Such points are grid nodes, saddles of faces and saddles
/// inside cells. Islands and holes of one node come on top, and `components`: one node of each component that shall
/// have one. The radius is the estimated distance from the place to the level set, world mm, and at least 1/20 of the
/// smallest voxel spacing. Places whose radius would be that spacing or more are left out.
///
/// - A face whose corners alternate in sign: its saddle, of height s, leads up along one diagonal and down along the
///   other. It is a place if the field leads up on both sides of the face or down on both (if not, the surface there
///   is a plain slope). Radius: √(2|s|/κ), κ the curvature of the bilinear function in the direction of world space
///   that reaches the level first; or |s| over the slope across the face, if that leads to the level and is less.
/// - A saddle inside a cell where corners of one sign are not joined by edges. Radius: √(2|s|/κ), κ the eigenvalue
///   of the Hessian in world space that leads to the level.
/// - A node whose six neighbours all have the other sign; or all but the two along one axis (a thread), where these
///   are not nearer the level; or just the two along one axis (a sheet), where the four others are farther from it.
///   Radius: to the nearest crossing on the node's six edges, as for `components`.
///
/// Return: in the order of the sweep (layer by layer along z), then the components.
std::vector<SizeHint> narrow_places(const HeightGrid& heights, const Frame& frame,
                                    const std::vector<std::array<int, 3>>& components);

}  // namespace scantet
