// What scripts/calibrate_plan.py has measured and fitted; it prints these lines.
#pragma once

namespace scantet {

/// Vertices for one of each feature of a domain (mesh_prediction.h).
struct VertexCosts {
  double inside;
  double cubes;
  double narrow;
  double bent;
};

/// Costs by where the vertices come from.
struct ShareCosts {
  double inside;    ///< for each vertex of the lattice inside
  double boundary;  ///< for each of the boundary where it is smooth
  double rough;     ///< for each that narrow and bent places take
  double least;     ///< in any case
};

inline constexpr VertexCosts kVertexCosts{0.3386, 0.5999, 6.693, 2.993};
/// A vertex has so many tets far from the boundary; less kTetsLost / (kTetsRoom + room), room: inside over cubes.
inline constexpr double kTetsInside = 6.169;
inline constexpr double kTetsLost = 5.917;
inline constexpr double kTetsRoom = 1.5;
inline constexpr ShareCosts kByteCosts{1331, 1244, 2857, 1.091e7};
inline constexpr ShareCosts kSecondCosts{6.875e-06, 8.637e-06, 1.555e-4,
                                         0.03845};  // of processor time, on the machine measured
inline constexpr double kTrialSeconds = 0.0472;     // what the trial of app/machine_speed takes there
inline constexpr double kSerialShare = 0.14;  // of the time on one thread, how much several threads do not shorten

}  // namespace scantet
