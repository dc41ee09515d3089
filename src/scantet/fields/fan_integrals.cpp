// A term of degree d around the corner o has over a triangle the integral of its mean along the edge that faces o,
// times the cross product of the sides at o, divided by d + 2. The mean along an edge follows from its middle m and its
// half h: of all odd powers of the place on it nothing is left, h stands for h / √3, so that squares have the mean h²,
// and fourth powers 9/5 h⁴. Loops over lanes become vector instructions, to the same bits as one by one.
#include "scantet/base/sanitizers.h"
#include "scantet/fields/fan_integrals_impl.h"

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(SCANTET_IS_SANITIZED)
#define SCANTET_FAN_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SCANTET_FAN_CLONES
#endif

namespace scantet {
namespace {

constexpr double kHalfRoot = 0.28867513459481288;  // 1 / (2 √3)

/// one + v·y + w·z + vw·y·z
struct Bilinear {
  double one, v, w, vw;
};

/// The bilinear map of a square from the values at its corners, around (v0, w0).
inline Bilinear bilinear(double h0, double h1, double h2, double h3, double v0, double w0) {
  const double v = h1 - h0;
  const double w = h2 - h0;
  const double vw = (h3 - h2) - v;
  const double w_there = w + vw * v0;
  return {h0 + v * v0 + w_there * w0, v + vw * w0, w_there, vw};
}

/// Means of products along an edge; u, v, w are the coordinates from the fan's corner o.
struct EdgeMeans {
  double u, v, w, vw, uv, uw, uvw, uu, uuv, uuw, uuvw;
  double cross;

  EdgeMeans(double au, double av, double aw, double bu, double bv, double bw)
      : u(0.5 * (au + bu)), v(0.5 * (av + bv)), w(0.5 * (aw + bw)), cross(av * bw - aw * bv) {
    const double hu = kHalfRoot * (bu - au), hv = kHalfRoot * (bv - av), hw = kHalfRoot * (bw - aw);
    const double huu = hu * hu, hvw = hv * hw;
    const double uv_slope = u * hv + v * hu, vw_slope = v * hw + w * hv, uu_slope = 2 * u * hu;
    vw = v * w + hvw;
    uv = u * v + hu * hv;
    uw = u * w + hu * hw;
    uvw = uv * w + uv_slope * hw;
    uu = u * u + huu;
    uuv = uu * v + uu_slope * hv;
    uuw = uu * w + uu_slope * hw;
    uuvw = uu * vw + uu_slope * vw_slope + 0.8 * huu * hvw;
  }
};

}  // namespace

SCANTET_FAN_CLONES void integrate_columns(const Fans& fans, const ColumnHeights& heights,
                                          ColumnIntegrals& __restrict result) {
  for (std::size_t i = 0; i < kFans; ++i) {
    const double ou = fans.o[0][i], ov = fans.o[1][i], ow = fans.o[2][i];
    const double u0 = ou - fans.cell[0][i], v0 = ov - fans.cell[1][i], w0 = ow - fans.cell[2][i];
    double half_rise[4], at_o[4];  // the antiderivative is u (height + half_rise u)
    for (std::size_t r = 0; r < 4; ++r) {
      half_rise[r] = 0.5 * (heights.after[r][i] - heights.at[r][i]);
      at_o[r] = heights.at[r][i] + u0 * half_rise[r];
    }
    const Bilinear f = bilinear(at_o[0], at_o[1], at_o[2], at_o[3], v0, w0);
    const Bilinear d = bilinear(half_rise[0], half_rise[1], half_rise[2], half_rise[3], v0, w0);
    const Bilinear once{(f.one + u0 * d.one) / 3, (f.v + u0 * d.v) / 4, (f.w + u0 * d.w) / 4, (f.vw + u0 * d.vw) / 5};
    const Bilinear twice{d.one / 4, d.v / 5, d.w / 5, d.vw / 6};
    const double bu = fans.b[0][i] - ou, bv = fans.b[1][i] - ov, bw = fans.b[2][i] - ow;
    const EdgeMeans p(fans.a[0][i] - ou, fans.a[1][i] - ov, fans.a[2][i] - ow, bu, bv, bw);
    const EdgeMeans q(bu, bv, bw, fans.c[0][i] - ou, fans.c[1][i] - ov, fans.c[2][i] - ow);
    const auto rest = [&](const EdgeMeans& m) {
      return m.cross * ((once.one * m.u + once.v * m.uv + once.w * m.uw + once.vw * m.uvw) +
                        (twice.one * m.uu + twice.v * m.uuv + twice.w * m.uuw + twice.vw * m.uuvw));
    };
    const double one = (p.cross + q.cross) / 2;
    const double v = (p.cross * p.v + q.cross * q.v) / 3;
    const double w = (p.cross * p.w + q.cross * q.w) / 3;
    const double vw = (p.cross * p.vw + q.cross * q.vw) / 4;
    const double from_cell = rest(p) + rest(q) + u0 * (f.one * one + f.v * v + f.w * w + f.vw * vw);
    const double all_v = v0 * one + v, all_w = w0 * one + w, all_vw = v0 * all_w + w0 * v + vw;
    const double weight[4] = {(one - all_v) - (all_w - all_vw), all_v - all_vw, all_w - all_vw, all_vw};
    double below = 0, above = 0;
    for (std::size_t r = 0; r < 4; ++r) {
      result.weight[r][i] = weight[r];
      below += weight[r] * (heights.before[r][i] + heights.at[r][i]);
      above += weight[r] * (heights.at[r][i] + heights.after[r][i]);
    }
    for (std::size_t s = 0; s < 2; ++s) {
      const double start = heights.start[s][i];
      result.integral[s][i] = from_cell + ((start < 0 ? 0.5 : 0) * below - (start > 0 ? 0.5 : 0) * above);
    }
  }
}

SCANTET_FAN_CLONES void integrate_bends(const Fans& fans, const std::array<FanLane, 4>& bends,
                                        FanLane& __restrict result) {
  for (std::size_t i = 0; i < kFans; ++i) {
    const double ou = fans.o[0][i], ov = fans.o[1][i], ow = fans.o[2][i];
    const Bilinear d =
        bilinear(bends[0][i], bends[1][i], bends[2][i], bends[3][i], ov - fans.cell[1][i], ow - fans.cell[2][i]);
    const Bilinear half{d.one / 8, d.v / 10, d.w / 10, d.vw / 12};
    const double bu = fans.b[0][i] - ou, bv = fans.b[1][i] - ov, bw = fans.b[2][i] - ow;
    const EdgeMeans p(fans.a[0][i] - ou, fans.a[1][i] - ov, fans.a[2][i] - ow, bu, bv, bw);
    const EdgeMeans q(bu, bv, bw, fans.c[0][i] - ou, fans.c[1][i] - ov, fans.c[2][i] - ow);
    const auto of = [&](const EdgeMeans& m) {
      return m.cross * (half.one * m.uu + half.v * m.uuv + half.w * m.uuw + half.vw * m.uuvw);
    };
    result[i] = of(p) + of(q);
  }
}

}  // namespace scantet
