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
    return read_label_table(file.path()).names;
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
  EXPECT_EQ(names("\xef\xbb\xbfindex\tname\n0\tUnknown\n17\tLeft-Hippocampus\n"), two) << "a byte order mark";
  EXPECT_EQ(names("\xef\xbb\xbf"
                  "0 Unknown\n17 Left-Hippocampus\n"),
            two);
  EXPECT_EQ(names("1 Area 4 255 0 0 0\n2 4 3 1 1 1 0\n"), (LabelNames{{1, "Area 4"}, {2, "4 3"}}));
  EXPECT_EQ(names("44 Brodmann area 44\n"), (LabelNames{{44, "Brodmann area 44"}}));
  EXPECT_EQ(test::error_code([&] { names("no labels\n"); }), "input.labels");
  EXPECT_EQ(test::error_code([] { read_label_table("/no such file"); }), "input.missing");
}

TEST(LabelNames, AreFoundBesideAnImageAndInItsHeader) {
  const TextFile beside("image.nii.txt", "3 Three\n");
  const std::string image = beside.path().substr(0, beside.path().size() - 4);
  EXPECT_EQ(table_beside(image).names, (LabelNames{{3, "Three"}}));
  EXPECT_EQ(table_beside(image + ".gz").names, (LabelNames{{3, "Three"}}));
  EXPECT_TRUE(table_beside("/no such image").names.empty());
  const LabelTable named = table_of_segments({{4, "left lung", Color{128, 255, 0}}, {7, "", std::nullopt}});
  EXPECT_EQ(named.names, (LabelNames{{4, "left lung"}}));
  EXPECT_EQ(named.colors, (std::map<std::int64_t, Color>{{4, {128, 255, 0}}}));
}

TEST(LabelNames, TablesHaveColours) {
  using Colors = std::map<std::int64_t, Color>;
  const auto colors = [](const std::string& text) {
    const TextFile file("coloured_labels.txt", text);
    return read_label_table(file.path()).colors;
  };
  const Colors hippocampus{{17, {220, 216, 20}}};
  EXPECT_EQ(colors("17  Left-Hippocampus  220 216 20 0\n"), hippocampus);
  EXPECT_EQ(colors("17  Area 4 220 216 20 0\n"), hippocampus) << "the name ends in a number";
  EXPECT_EQ(colors("\xef\xbb\xbfindex\tname\tcolor\n17\tLeft-Hippocampus\t#dcd814\n"), hippocampus);
  EXPECT_EQ(colors("17 220 216 20 1 1 1 \"Left-Hippocampus\"\n"), hippocampus);
  EXPECT_EQ(colors("index\tname\tcolor\n17\tLeft-Hippocampus\t#dcd814\n18\tNone\tred\n"), hippocampus);
  EXPECT_EQ(colors("17 Left-Hippocampus 4101\n18 Area 300 0 0 0\n"), Colors()) << "a code, and no colour";
  std::string lut(768, '\0');
  lut[3] = '\7';
  lut[256 + 3] = '\x8';
  lut[512 + 3] = '\xff';
  const TextFile beside("c.nii.lut", lut);
  const std::string image = beside.path().substr(0, beside.path().size() - 4);
  EXPECT_EQ(table_beside(image + ".gz").colors.at(3), (Color{7, 8, 255}));
  const TextFile cut_short("d.nii.lut", lut.substr(1));
  EXPECT_TRUE(table_beside(cut_short.path().substr(0, cut_short.path().size() - 4)).colors.empty());
  LabelChoice both{false, {{1, 2, 8, "both", ""}}};
  const LabelSettings settings = settings_of(both, {{}, {{2, {1, 2, 3}}, {0, {4, 4, 4}}}}, {{0, 1}, {1, 1}, {2, 1}});
  EXPECT_EQ(settings.colors, (std::map<Region, Color>{{8, {1, 2, 3}}}));
}

TEST(LabelChoice, ListsAndTablesAreRead) {
  EXPECT_TRUE(read_label_choice("--labels", "all").all);
  const LabelChoice list = read_label_choice("--labels", "1,3,7-12");
  ASSERT_EQ(list.ranges.size(), 3U);
  EXPECT_EQ(list.ranges[2].first, 7);
  EXPECT_EQ(list.ranges[2].last, 12);
  const TextFile file("choice.txt", "1-2 8 both\n3 \"a third\"\n4 0\n");
  const LabelSettings settings =
      settings_of(read_label_choice("--labels", file.path()), {{{3, "three"}, {5, "five"}}, {}},
                  {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}});
  EXPECT_FALSE(settings.keep_others);
  EXPECT_EQ(settings.region_of, (std::map<std::int64_t, Region>{{1, 8}, {2, 8}, {3, 3}, {4, 0}}));
  EXPECT_EQ(settings.names, (std::map<Region, std::string>{{3, "a third"}, {8, "both"}}));
}

TEST(LabelChoice, NamesGoWithLabelsThatAreARegionOfTheirOwn) {
  const TextFile file("choice.txt", "1 8\n2 8\n3 9\n");
  const LabelTable names{{{1, "one"}, {2, "two"}, {3, "three"}}, {}};
  const std::vector<LabelCount> labels{{0, 1}, {1, 1}, {2, 1}, {3, 1}};
  EXPECT_EQ(settings_of(read_label_choice("--labels", file.path()), names, labels).names,
            (std::map<Region, std::string>{{9, "three"}}));
  EXPECT_EQ(settings_of({}, names, labels).names.size(), 3U);
}

}  // namespace
}  // namespace scantet
