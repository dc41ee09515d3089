// Reads a NIfTI file with the format's own library (Debian's libnifti2-dev), and prints what it makes of it; for
// scripts/reader_experiments.py. Status 0: read; 3: refused.
#include <nifti2_io.h>
#include <stdio.h>

int main(int count, char** words) {
  if (count != 2) return 2;
  nifti_image* image = nifti_image_read(words[1], 1);
  if (image == NULL || image->data == NULL) return 3;
  double sum = 0;
  const unsigned char* bytes = image->data;
  for (int64_t i = 0; i < image->nvox * image->nbyper; ++i) sum += bytes[i];
  printf("size %ld x %ld x %ld, sum of bytes %.17g, sform origin (%g, %g, %g)\n", (long)image->nx, (long)image->ny,
         (long)image->nz, sum, image->sto_xyz.m[0][3], image->sto_xyz.m[1][3], image->sto_xyz.m[2][3]);
  nifti_image_free(image);
  return 0;
}
