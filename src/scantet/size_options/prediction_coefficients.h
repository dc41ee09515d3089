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

inline constexpr VertexCosts kVertexCosts{0.3501, 0.5577, 12.11, 2.181};
/// A vertex has so many tets far from the boundary; less kTetsLost / (kTetsRoom + room), room: inside over cubes.
inline constexpr double kTetsInside = 6.239;
inline constexpr double kTetsLost = 6.101;
inline constexpr double kTetsRoom = 1.5;
inline constexpr ShareCosts kByteCosts{1176, 2067, 1881, 6.272e6};
inline constexpr ShareCosts kSecondCosts{5.12e-6, 2.607e-5, 6.7e-5,
                                         0.01438};  // of processor time, on the machine measured
inline constexpr double kTrialSeconds = 0.0402;     // what the trial of app/machine_speed takes there
inline constexpr double kSerialShare = 0.3;  // of the time on one thread, how much several threads do not shorten

}  // namespace scantet
