#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "error_code.h"
#include "scantet/labels/label_choice.h"

namespace scantet {
namespace {

/// A file of the running test, removed by the destructor.
class TextFile {
 public:
  TextFile(const std::string& name, const std::string& text)
      : path_(::testing::TempDir() + std::to_string(getpid()) + name) {
    std::ofstream(path_) << text;
  }
  ~TextFile() { std::remove(path_.c_str()); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(LabelNames, TablesOfSeveralProgramsAreRead) {
  const auto names = [](const std::string& text) {
    const TextFile file("labels_of_a_program.txt", text);
    return read_label_names(file.path());
  };
  const LabelNames two{{0, "Unknown"}, {17, "Left-Hippocampus"}};
  EXPECT_EQ(names("#No. Label Name:      R G B A\n\n0   Unknown   0 0 0 0\n17  Left-Hippocampus  220 216 20 0\n"), two);
  EXPECT_EQ(names("# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Unknown\"\n"
                  "   17   255    0    0        1  1  1    \"Left-Hippocampus\"\n"),
            two);
  EXPECT_EQ(names("index\tname\tcolor\n0\tUnknown\t#000000\r\n17\tLeft-Hippocampus\t#dcd814\r\n"), two);
  EXPECT_EQ(names("name\tindex\nUnknown\t0\nLeft-Hippocampus\t17\n"), two);
  EXPECT_EQ(names("0 Unknown 1000\n17 Left-Hippocampus 4101\n"), two);
  EXPECT_EQ(names("0\tUnknown\r\n17\tLeft-Hippocampus\r\n"), two);
  EXPECT_EQ(names("44 Brodmann area 44\n"), (LabelNames{{44, "Brodmann area 44"}}));
  EXPECT_EQ(test::error_code([&] { names("no labels\n"); }), "input.labels");
  EXPECT_EQ(test::error_code([] { read_label_names("/no such file"); }), "input.missing");
}

TEST(LabelNames, AreFoundBesideAnImageAndInTheHeaderOfASegmentation) {
  const TextFile beside("image.nii.txt", "3 Three\n");
  const std::string image = beside.path().substr(0, beside.path().size() - 4);
  EXPECT_EQ(names_beside(image), (LabelNames{{3, "Three"}}));
  EXPECT_EQ(names_beside(image + ".gz"), (LabelNames{{3, "Three"}}));
  EXPECT_TRUE(names_beside("/no such image").empty());
  const TextFile segments(
      "a.seg.nrrd",
      "NRRD0004\ntype: uchar\nSegment0_LabelValue:=4\nSegment0_Name:=left lung\r\nSegment1_Name:=two\n"
      "Segment1_LabelValue:=7\nSegment2_Name:=no value\n\nSegment3_LabelValue:=9\nSegment3_Name:=late\n");
  EXPECT_EQ(names_of_segments(segments.path()), (LabelNames{{4, "left lung"}, {7, "two"}}));
  EXPECT_TRUE(names_of_segments(beside.path()).empty());
}

TEST(LabelChoice, ListsAndTablesAreRead) {
  EXPECT_TRUE(read_label_choice("--labels", "all").all);
  const LabelChoice list = read_label_choice("--labels", "1,3,7-12");
  ASSERT_EQ(list.ranges.size(), 3U);
  EXPECT_EQ(list.ranges[2].first, 7);
  EXPECT_EQ(list.ranges[2].last, 12);
  const TextFile file("choice.txt", "1-2 8 both\n3 \"a third\"\n4 0\n");
  const LabelSettings settings = settings_of(read_label_choice("--labels", file.path()), {{3, "three"}, {5, "five"}},
                                             {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}});
  EXPECT_FALSE(settings.keep_others);
  EXPECT_EQ(settings.region_of, (std::map<std::int64_t, Region>{{1, 8}, {2, 8}, {3, 3}, {4, 0}}));
  EXPECT_EQ(settings.names, (std::map<Region, std::string>{{3, "a third"}, {8, "both"}}));
}

TEST(LabelChoice, NamesGoWithLabelsThatAreARegionOfTheirOwn) {
  const TextFile file("choice.txt", "1 8\n2 8\n3 9\n");
  const LabelNames names{{1, "one"}, {2, "two"}, {3, "three"}};
  const std::vector<LabelCount> labels{{0, 1}, {1, 1}, {2, 1}, {3, 1}};
  EXPECT_EQ(settings_of(read_label_choice("--labels", file.path()), names, labels).names,
            (std::map<Region, std::string>{{9, "three"}}));
  EXPECT_EQ(settings_of({}, names, labels).names.size(), 3U);
}

}  // namespace
}  // namespace scantet
