// Sorts a folder's DICOM slices with GDCM's IPPSorter and computes their spacing with it; for
// scripts/reader_experiments.py. Status 0: sorted; 3: refused.
#include <gdcmDirectory.h>
#include <gdcmIPPSorter.h>

#include <cstdio>

int main(int count, char** words) {
  if (count != 2) return 2;
  gdcm::Directory folder;
  folder.Load(words[1]);
  gdcm::IPPSorter sorter;
  sorter.SetComputeZSpacing(true);
  sorter.SetZSpacingTolerance(1e-3);
  if (!sorter.Sort(folder.GetFilenames())) return 3;
  std::printf("%zu slices, spacing %.17g mm\n", sorter.GetFilenames().size(), sorter.GetZSpacing());
  return 0;
}
