// Means come from fluxes through facets (facet_fluxes_impl.h), and for some tets, as do all other measures, from pieces
// of tets: in a cell the trilinear map is a polynomial in x, y, z with each at most once, so its integral over a tet
// takes the means of products of up to three linear functions, which have closed forms; its square is integrated by a
// rule of degree 7, which is more than the 6 it has. Labels and ranks are of voxels, whose boxes are the cells of a
// grid that is shifted by half a step.
#include "scantet/fields/scan_field.h"

#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/base/tet_volume.h"
#include "scantet/base/trilinear.h"
#include "scantet/fields/facet_means_impl.h"
#include "scantet/fields/grid_pieces_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kGrain = 512;
constexpr double kNoShare = 1e-9;    // of a tet: less is rounding
constexpr double kNoOutside = 1e-6;  // voxels

/// Mean of the product of linear functions over a tet, from their values at its corners.
using Corners = std::array<double, 4>;
double sum(const Corners& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}
double sum(const Corners& a, const Corners& b) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}
double sum(const Corners& a, const Corners& b, const Corners& c) {
  return (a[0] * b[0] * c[0] + a[1] * b[1] * c[1]) + (a[2] * b[2] * c[2] + a[3] * b[3] * c[3]);
}

/// The trilinear map of a cell as a polynomial in local coordinates.
struct CellPolynomial {
  double one, x, y, z, xy, yz, xz, xyz;

  explicit CellPolynomial(const CellHeights& h)
      : one(h[0]),
        x(h[1] - h[0]),
        y(h[2] - h[0]),
        z(h[4] - h[0]),
        xy((h[3] - h[2]) - (h[1] - h[0])),
        yz((h[6] - h[4]) - (h[2] - h[0])),
        xz((h[5] - h[4]) - (h[1] - h[0])),
        xyz(((h[7] - h[6]) - (h[5] - h[4])) - ((h[3] - h[2]) - (h[1] - h[0]))) {}

  double at(double u, double v, double w) const {
    return one + (x * u + y * v + z * w) + (xy * u * v + yz * v * w + xz * u * w) + xyz * u * v * w;
  }
};

/// Integrals of the terms of such a polynomial over tets in its cell.
struct Moments {
  double one = 0, x = 0, y = 0, z = 0, xy = 0, yz = 0, xz = 0, xyz = 0;

  /// a, b, c: the local coordinates of the corners by axis.
  void add(double volume, const Corners& a, const Corners& b, const Corners& c) {
    const double sa = sum(a), sb = sum(b), sc = sum(c);
    const double ab = sum(a, b), bc = sum(b, c), ac = sum(a, c);
    one += volume;
    const double quarter = volume / 4, twentieth = volume / 20;
    x += quarter * sa;
    y += quarter * sb;
    z += quarter * sc;
    xy += twentieth * (sa * sb + ab);
    yz += twentieth * (sb * sc + bc);
    xz += twentieth * (sa * sc + ac);
    xyz += volume / 120 * (sa * sb * sc + sa * bc + sb * ac + sc * ab + 2 * sum(a, b, c));
  }
  double integral(const CellPolynomial& f) const {
    return f.one * one + (f.x * x + f.y * y + f.z * z) + (f.xy * xy + f.yz * yz + f.xz * xz) + f.xyz * xyz;
  }
};

/// A point of a tet and its weight in a mean.
struct RulePoint {
  std::array<double, 4> share;
  double weight;
};

/// Grundmann and Moeller's rule of degree 7 for tets: 35 points.
std::vector<RulePoint> make_rule() {
  constexpr int kLevels = 3;
  constexpr int kDegree = 2 * kLevels + 1;
  std::vector<RulePoint> rule;
  for (int i = 0; i <= kLevels; ++i) {
    const double scale = kDegree + 3 - 2 * i;
    double weight =
        6 * std::pow(2, -2 * kLevels) * std::pow(scale, kDegree);  // of a mean: 3! times that of the integral
    for (int k = 2; k <= i; ++k) weight /= k;
    for (int k = 2; k <= kDegree + 3 - i; ++k) weight /= k;
    if (i % 2 == 1) weight = -weight;
    const int all = kLevels - i;
    for (int a = 0; a <= all; ++a) {
      for (int b = 0; a + b <= all; ++b) {
        for (int c = 0; a + b + c <= all; ++c) {
          const int d = all - a - b - c;
          rule.push_back(
              {{(2 * a + 1) / scale, (2 * b + 1) / scale, (2 * c + 1) / scale, (2 * d + 1) / scale}, weight});
        }
      }
    }
  }
  return rule;
}

Vec centroid(const IndexTet& t) {
  return 0.25 * ((t[0] + t[1]) + (t[2] + t[3]));
}

/// One measure of voxels of one type over tets in index space. Each thread has its own.
template <class Voxel>
class TetMeasure {
 public:
  TetMeasure(const Scan& scan, const Voxel* voxels, const FieldChoice& choice)
      : size_(scan.size),
        voxels_(voxels),
        choice_(choice),
        last_{scan.size[0] - 1, scan.size[1] - 1, scan.size[2] - 1} {}

  double of(IndexTet tet) {
    if (tet_volume(tet) < 0) std::swap(tet[2], tet[3]);
    switch (choice_.measure) {
      case FieldMeasure::mean:
        return mean_of(tet);
      case FieldMeasure::std:
        return std_of(tet);
      default:
        break;
    }
    for (Vec& p : tet) p = p + Vec{0.5, 0.5, 0.5};
    shares_.clear();
    double volume = 0;
    GridCell cell{};
    cut_by_grid(Piece(tet), 1, last_, 0, cell, [&](const GridCell& at_cell, const Piece& piece) {
      double share = 0;
      piece.for_each_tet([&](const auto& corners) { share += tet_volume(piece.tet_of(corners)); });
      volume += share;
      shares_.push_back({at(at_cell[0], at_cell[1], at_cell[2]), share});
    });
    if (!(volume > 0)) {  // all of it is in one voxel
      shares_ = {{voxel_of(centroid(tet)), 1}};
      volume = 1;
    }
    return of_shares(volume);
  }

 private:
  struct Share {
    double value;
    double volume;
  };
  double at(int i, int j, int k) const {
    const auto row = static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j);
    return static_cast<double>(voxels_[row * static_cast<std::size_t>(size_[0]) + static_cast<std::size_t>(i)]);
  }

  int index_in(double coordinate, int axis, int last) const {
    return static_cast<int>(
        std::clamp(std::floor(coordinate), 0.0, static_cast<double>(size_[static_cast<std::size_t>(axis)] - last)));
  }

  double voxel_of(const Vec& shifted) const {
    return at(index_in(shifted.x, 0, 1), index_in(shifted.y, 1, 1), index_in(shifted.z, 2, 1));
  }

  CellHeights heights(const GridCell& low) const {
    CellHeights h;
    for (int corner = 0; corner < 8; ++corner) {
      h[static_cast<std::size_t>(corner)] =
          at(low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2));
    }
    return h;
  }

  /// Calls take(polynomial of the cell, piece, local coordinates of its corners by axis). Beyond the outermost centres
  /// the function is that at the nearest cell's side.
  template <class Take>
  void for_each_polynomial(const IndexTet& tet, const Take& take) {
    GridCell cell{};
    cut_by_grid(Piece(tet), 0, last_, 0, cell, [&](const GridCell& in, const Piece& piece) {
      GridCell low;
      std::array<std::array<double, 32>, 3> local;
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::clamp(in[a], 0, size_[a] - 2);
        for (std::size_t i = 0; i < piece.corner_count(); ++i) {
          local[a][i] = std::clamp(piece.corner(i)[static_cast<int>(a)] - low[a], 0.0, 1.0);
        }
      }
      take(CellPolynomial(heights(low)), piece, local);
    });
  }

  /// Those of the corners of a tet.
  static Corners of_tet(const std::array<double, 32>& local, const std::array<std::size_t, 4>& c) {
    return {local[c[0]], local[c[1]], local[c[2]], local[c[3]]};
  }

  double trilinear_at(const Vec& p) const {
    std::array<int, 3> low;
    Vec local;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      low[a] = index_in(p[axis], axis, 2);
      local[axis] = std::clamp(p[axis] - low[a], 0.0, 1.0);
    }
    return trilinear(heights(low), local);
  }

  double mean_of(const IndexTet& tet) {
    double volume = 0;
    double integral = 0;
    for_each_polynomial(tet, [&](const CellPolynomial& f, const Piece& piece, const auto& local) {
      Moments moments;
      piece.for_each_tet([&](const std::array<std::size_t, 4>& c) {
        moments.add(tet_volume(piece.tet_of(c)), of_tet(local[0], c), of_tet(local[1], c), of_tet(local[2], c));
      });
      volume += moments.one;
      integral += moments.integral(f);
    });
    return volume > 0 ? integral / volume : trilinear_at(centroid(tet));
  }

  double std_of(const IndexTet& tet) {
    static const std::vector<RulePoint> rule = make_rule();
    const double mean = mean_of(tet);
    double volume = 0;
    double integral = 0;
    for_each_polynomial(tet, [&](const CellPolynomial& f, const Piece& piece, const auto& local) {
      piece.for_each_tet([&](const std::array<std::size_t, 4>& c) {
        const Corners a = of_tet(local[0], c), b = of_tet(local[1], c), d = of_tet(local[2], c);
        double squares = 0;
        for (const RulePoint& point : rule) {
          const double off = f.at(sum(a, point.share), sum(b, point.share), sum(d, point.share)) - mean;
          squares += point.weight * off * off;
        }
        const double share = tet_volume(piece.tet_of(c));
        volume += share;
        integral += share * squares;
      });
    });
    return volume > 0 && integral > 0 ? std::sqrt(integral / volume) : 0;
  }

  double of_shares(double volume) {
    double part = 0;
    if (choice_.measure == FieldMeasure::fraction) {
      for (const Share& share : shares_) part += share.value == choice_.label ? share.volume : 0;
      return part / volume;
    }
    std::sort(shares_.begin(), shares_.end(), [](const Share& a, const Share& b) {
      return a.value != b.value ? a.value < b.value : a.volume < b.volume;
    });
    // Pieces of one value together, and from above if the largest is asked for.
    if (choice_.measure == FieldMeasure::max) std::reverse(shares_.begin(), shares_.end());
    const double enough = choice_.measure == FieldMeasure::median ? volume / 2 : kNoShare * volume;
    for (std::size_t i = 0; i < shares_.size();) {
      const double value = shares_[i].value;
      double alike = 0;
      for (; i < shares_.size() && shares_[i].value == value; ++i) alike += shares_[i].volume;
      part = choice_.measure == FieldMeasure::median ? part + alike : alike;
      if (part >= enough) return value;
    }
    return shares_.back().value;
  }

  std::array<int, 3> size_;
  const Voxel* voxels_;
  FieldChoice choice_;
  std::array<int, 3> last_;  // of the planes: through voxel centres, or where boxes begin half a step earlier
  std::vector<Share> shares_;
};

bool is_outside(const IndexTet& tet, const std::array<int, 3>& size) {
  for (const Vec& p : tet) {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < -0.5 - kNoOutside || p[axis] > size[static_cast<std::size_t>(axis)] - 0.5 + kNoOutside) return true;
    }
  }
  return false;
}

}  // namespace

ScanField scan_field(const TetMesh& mesh, const Scan& scan, const FieldChoice& choice) {
  ScanField field;
  field.values.resize(mesh.tets.size());
  std::vector<Vec> places(mesh.vertices.size());
  parallel_for(places.size(), 8 * kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) places[v] = scan.frame.to_index(mesh.vertices[v]);
  });
  struct Part {
    std::uint64_t outside = 0;
    double total = 0;
  };
  std::vector<Part> parts((mesh.tets.size() + kGrain - 1) / kGrain);
  std::visit(
      [&](const auto* voxels) {
        std::vector<double> known;
        if (choice.measure == FieldMeasure::mean) known = facet_means(mesh, places, scan, voxels);
        parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
          TetMeasure measure(scan, voxels, choice);
          Part& part = parts[begin / kGrain];
          for (std::size_t t = begin; t < end; ++t) {
            IndexTet tet;
            for (std::size_t i = 0; i < 4; ++i) tet[i] = places[mesh.tets[t][i]];
            part.outside += is_outside(tet, scan.size) ? 1 : 0;
            field.values[t] = known.empty() || std::isnan(known[t]) ? measure.of(tet) : known[t];
            part.total += field.values[t] * tet_volume_mm3(mesh, t);
          }
        });
      },
      scan.voxels);
  for (const Part& part : parts) {
    field.tets_outside += part.outside;
    field.total += part.total;
  }
  return field;
}

}  // namespace scantet
