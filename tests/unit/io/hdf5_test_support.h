// What the HDF5 library finds in a file.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>

#include <string>
#include <vector>

namespace scantet {

/// The array in its own order; its extents go to `extents`, if asked for. type: of Number in memory.
template <typename Number>
std::vector<Number> numbers_in(const std::string& file, const std::string& path, hid_t type,
                               std::vector<hsize_t>* extents = nullptr) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_GE(opened, 0) << file;
  const hid_t array = H5Dopen2(opened, path.c_str(), H5P_DEFAULT);
  EXPECT_GE(array, 0) << path;
  const hid_t space = H5Dget_space(array);
  if (extents != nullptr) {
    extents->resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, extents->data(), nullptr);
  }
  std::vector<Number> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space);
  H5Dclose(array);
  H5Fclose(opened);
  return values;
}

/// The first text of an array of texts with 80 characters each.
inline std::string text_in(const std::string& file, const std::string& path) {
  constexpr hsize_t kLength = 80;
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t array = H5Dopen2(opened, path.c_str(), H5P_DEFAULT);
  EXPECT_GE(array, 0) << path;
  const hid_t type = H5Tarray_create2(H5T_NATIVE_SCHAR, 1, &kLength);
  const hid_t space = H5Dget_space(array);
  std::string text(kLength * static_cast<std::size_t>(std::max<hssize_t>(1, H5Sget_simple_extent_npoints(space))), '?');
  H5Sclose(space);
  EXPECT_GE(H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), 0);
  H5Tclose(type);
  H5Dclose(array);
  H5Fclose(opened);
  return text.substr(0, text.find('\0'));
}

/// An attribute that is a whole number.
inline int attribute_in(const std::string& file, const std::string& path, const std::string& name) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t attribute = H5Aopen_by_name(opened, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(attribute, 0) << path << " " << name;
  int value = 0;
  EXPECT_GE(H5Aread(attribute, H5T_NATIVE_INT, &value), 0);
  H5Aclose(attribute);
  H5Fclose(opened);
  return value;
}

/// The names of what is in a group, in the order in which it was made.
inline std::vector<std::string> members_in(const std::string& file, const std::string& path) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t group = H5Gopen2(opened, path.c_str(), H5P_DEFAULT);
  EXPECT_GE(group, 0) << path;
  std::vector<std::string> names;
  const auto take = [](hid_t /*group*/, const char* name, const H5L_info_t* /*info*/, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  EXPECT_GE(H5Literate(group, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, take, &names), 0);
  H5Gclose(group);
  H5Fclose(opened);
  return names;
}

}  // namespace scantet
