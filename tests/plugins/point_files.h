// Points on surfaces that are known, and files of them, for tests to write and to spoil.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet {

struct Cloud {
  std::vector<Point> points;
  std::vector<Vec> normals;  ///< outwards; may be empty

  void add(const Cloud& other) {
    points.insert(points.end(), other.points.begin(), other.points.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  }
  Cloud without_normals() const { return {points, {}}; }
  Cloud turned() const {
    Cloud cloud = *this;
    for (Vec& normal : cloud.normals) normal = -1 * normal;
    return cloud;
  }

  std::string xyz() const {
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const double number : numbers(i)) text << number << " ";
      text << "\n";
    }
    return text.str();
  }
  std::string ply() const { return header("ascii", "double") + xyz(); }
  /// Little-endian floats.
  std::string binary_ply() const {
    std::string text = header("binary_little_endian", "float");
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const double number : numbers(i)) {
        const float value = static_cast<float>(number);
        std::array<char, sizeof(value)> bytes;
        std::memcpy(bytes.data(), &value, sizeof(value));
        text.append(bytes.data(), bytes.size());
      }
    }
    return text;
  }

 private:
  std::vector<double> numbers(std::size_t i) const {
    std::vector<double> numbers{points[i].x, points[i].y, points[i].z};
    if (!normals.empty()) numbers.insert(numbers.end(), {normals[i].x, normals[i].y, normals[i].z});
    return numbers;
  }
  std::string header(const std::string& format, const std::string& type) const {
    std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(points.size()) + "\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
      if (name[1] == '\0' || !normals.empty()) text += "property " + type + " " + name + "\n";
    }
    return text + "end_header\n";
  }
};

inline constexpr double kGolden = std::numbers::phi - 1;  // successive multiples spread evenly over the unit interval

/// About evenly spread.
inline Cloud ball_cloud(const Point& centre, double radius, int count) {
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double turn = 2 * std::numbers::pi * kGolden * i;
    const double ring = std::sqrt(1 - z * z);
    const Vec normal{ring * std::cos(turn), ring * std::sin(turn), z};
    cloud.normals.push_back(normal);
    cloud.points.push_back(centre + radius * normal);
  }
  return cloud;
}

/// Around the z axis; about evenly spread.
inline Cloud torus_cloud(double ring, double tube, int count) {
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    const double share = 2 * std::numbers::pi * (i + 0.5) / count;  // of the area: v + tube/ring · sin v
    double v = share;
    for (int step = 0; step < 60; ++step) v = share - tube / ring * std::sin(v);
    const double turn = 2 * std::numbers::pi * kGolden * i;
    const Vec out{std::cos(turn), std::sin(turn), 0};
    const Vec normal = std::cos(v) * out + Vec{0, 0, std::sin(v)};
    cloud.normals.push_back(normal);
    cloud.points.push_back(ring * out + tube * normal);
  }
  return cloud;
}

}  // namespace scantet
